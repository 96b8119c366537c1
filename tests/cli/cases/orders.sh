# Triangles and vertices in another order are hit as before, by the same ids; a single geometry's leaf order is then 0, 1, 2, ...
cp "$ROOT/samples/scenes/torus.ply" .
bvh-build torus.ply -o torus.bvhx
bvh-compress torus.bvhx --form aabb --codec none --triangle-order leaf --vertex-order use -o leaf.bvhx
code bvh-trace torus.bvhx --rays random --count 5000 --compare leaf.bvhx | tail -n 1
code bvh-stats leaf.bvhx --check
bvh-compress leaf.bvhx --codec topology -o small.bvhx
bvh-stats leaf.bvhx --diff small.bvhx | head -n 1
bvh-stats small.bvhx --chunks --format json | python3 -c '
import json, sys
for chunk in json.load(sys.stdin)["chunks"]:
    if chunk["type"] in ("PRIM", "SRCP", "TRIS", "TOPO"):
        print(chunk["type"], chunk["codec"], chunk["stored_size"] * 4 < chunk["raw_size"])'
# Draco takes the smaller order of vertices, and hits keep their ids.
bvh-compress torus.bvhx --geometry draco --vertex-order source -o source.bvhx
bvh-compress torus.bvhx --geometry draco --vertex-order use -o use.bvhx
bvh-compress torus.bvhx --geometry draco -o auto.bvhx
[ "$(bvh-stats auto.bvhx --format json --no-epo | json stored_bytes.geometry)" = \
    "$(for f in source use; do bvh-stats $f.bvhx --format json --no-epo | json stored_bytes.geometry; done | sort -n -k 2 | head -n 1)" ] && echo smaller
