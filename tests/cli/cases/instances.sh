# A scene with instances, traced through trees of its meshes: the hits are nearly those of the flattened scene, whatever the passes do.
scene=$SAMPLES/scenes/orchard.glb
bvh-build "$scene" -o flat.bvhx
bvh-build "$scene" --two-level -o levels.bvhx --report report.json
json primitives meshes instances instanced_primitives <report.json
bvh-stats levels.bvhx --check
bvh-stats levels.bvhx --format json >stats.json
json form primitives meshes instances instanced_primitives references epo <stats.json
bvh-trace flat.bvhx --rays random --count 20000 --save-rays random.rays --hits flat.hits --format json >flat.json
bvh-trace levels.bvhx --rays random.rays --hits levels.hits --image levels.png --format json >levels.json
bvh-trace levels.bvhx --heatmap cost.png --resolution 40x30 >/dev/null
python3 - <<'PYTHON'
import json, struct
flat, levels = ([struct.unpack_from("<3f3I", open(name + ".hits", "rb").read(), 16 + 24 * i) for i in range(20000)]
                for name in ("flat", "levels"))
other = sum(a[3:5] != b[3:5] or (a[3] != 0xFFFFFFFF and abs(a[0] - b[0]) > 1e-5 * a[0]) for a, b in zip(flat, levels))
print("other hits:", other if other > 20 else "few")
places = {b[5] for b in levels}
print("instances:", "many" if len(places) > 500 else len(places), "at most", max(places - {0xFFFFFFFF}) < 2000)
sizes = [json.load(open(name + ".json"))["bytes"] for name in ("flat", "levels")]
flat, levels = (s["nodes"] + s["primitives"] + s["geometry"] for s in sizes)
print("smaller:", levels * 5 < flat)
PYTHON
# Passes work on each tree; hits stay as they are to the bit.
bvh-relayout levels.bvhx -o relaid.bvhx
bvh-restructure levels.bvhx -o restructured.bvhx
for tlas in $(bvh-compress --help | sed -n '/--tlas-form/,/--blas-form/s/^ \{36\}\([a-z0-9-]*\)  .*/\1/p'); do
    for blas in $(bvh-compress --help | sed -n '/--blas-form/,/--blas-size/s/^ \{36\}\([a-z0-9-]*\)  .*/\1/p'); do
        bvh-compress restructured.bvhx --form two-level --tlas-form "$tlas" --blas-form "$blas" -o "$tlas-over-$blas.bvhx"
    done
done
for file in relaid restructured *-over-*; do
    bvh-stats "${file%.bvhx}.bvhx" --check
    bvh-trace "${file%.bvhx}.bvhx" --rays random.rays --compare levels.bvhx >/dev/null || echo "$file has other hits"
done
bvh-compress levels.bvhx --form two-level | bvh-stats --format json --no-epo | json bytes.nodes
cat "$scene" | bvh-build --two-level | cmp - levels.bvhx
# Other scenes are one mesh in one place.
cube | bvh-build --two-level | bvh-trace --compare <(cube | bvh-build) --rays random --count 1000 --format json | json compare.differing
# What needs one tree says so.
code bvh-compress levels.bvhx --form aabb -o no.bvhx
code bvh-compress levels.bvhx --form two-level --tlas-form aabb --blas-form mvh --bits 6 -o no.bvhx
code bvh-compress levels.bvhx --leaf-size 8 -o no.bvhx
code bvh-compress levels.bvhx --form two-level --blas-size 4 -o no.bvhx
code bvh-compress levels.bvhx --form two-level --geometry draco -o no.bvhx
code bvh-compress levels.bvhx --max-slowdown 2 -o no.bvhx
code bvh-build "$scene" --refit levels.bvhx -o no.bvhx
code bvh-build "$scene" --two-level --refit flat.bvhx -o no.bvhx
code bvh-stats levels.bvhx --diff flat.bvhx
code bvh-stats levels.bvhx --levels
[ ! -e no.bvhx ]
