# Visits that bvh-trace counts drive layouts, go along with the nodes, and are gone once nodes are others.
grid 60 | bvh-build -o tree.bvhx
code bvh-relayout tree.bvhx --layout odfs --probability visits -o none.bvhx
code bvh-relayout tree.bvhx --layout odfs --smoothing 1 -o none.bvhx
code bvh-relayout tree.bvhx --layout veb --probability visits -o none.bvhx
bvh-trace tree.bvhx --rays diffuse --count 4000 --record-visits visited.bvhx >first.txt
code bvh-stats visited.bvhx --check
# The same bytes with one thread, and when other outputs are asked for too.
bvh-trace tree.bvhx --rays diffuse --count 4000 --repeat 1 -j 1 --hits hits --record-visits again.bvhx >/dev/null
cmp visited.bvhx again.bvhx
chunk() {
    bvh-stats "$1" --chunks --format json | python3 -c '
import json, sys
print(sum(c["type"] == "VISI" for c in json.load(sys.stdin)["chunks"]), "chunk of visits")'
}
hash() { tail -c 64 "$1" | head -c 8 | od -An -tx1; } # of the content, without provenance
for layout in $(bvh-relayout --help | sed -n '/--layout/,/^  -/s/^ \{36\}\([a-z0-9-]*\)  .*/\1/p'); do
    bvh-relayout visited.bvhx --layout "$layout" -o relaid.bvhx
    # Moved with the nodes they are what recording them anew gives.
    bvh-trace relaid.bvhx --rays diffuse --count 4000 --repeat 1 --record-visits recorded.bvhx >/dev/null
    [ "$(hash relaid.bvhx)" = "$(hash recorded.bvhx)" ] || echo "$layout: other visits"
    (bvh-stats visited.bvhx --diff relaid.bvhx || true) | grep -q '^verdict *\(identical\|order\)$' || echo "$layout: another tree"
done
# Fewer jumps over the lines of the recorded rays than by areas.
jumps() {
    bvh-trace "$1" --rays diffuse --count 4000 --repeat 1 --format json | python3 -c 'import json, sys; print(json.load(sys.stdin)["CMC"]["4096"])'
}
bvh-relayout visited.bvhx --layout odfs --probability visits --smoothing 0 -o visits.bvhx
bvh-relayout visited.bvhx --layout odfs -o areas.bvhx
[ "$(printf '%s\n' "$(jumps visits.bvhx)" "$(jumps areas.bvhx)" | sort -g | head -n 1)" = "$(jumps visits.bvhx)" ] || echo "visits jump more"
chunk visited.bvhx
chunk relaid.bvhx
bvh-compress visited.bvhx --codec topology | bvh-relayout --layout pack --probability visits -o relaid.bvhx
chunk relaid.bvhx
bvh-restructure visited.bvhx -o other.bvhx
chunk other.bvhx
bvh-compress visited.bvhx --form quantized -o other.bvhx
chunk other.bvhx
bvh-trace other.bvhx --rays primary --resolution 64x48 --record-visits other.bvhx >/dev/null
chunk other.bvhx
bvh-build "$ROOT/samples/scenes/orchard.glb" --two-level -o orchard.bvhx
code bvh-trace orchard.bvhx --record-visits none.bvhx
ls none.bvhx 2>/dev/null || echo "nothing written"
