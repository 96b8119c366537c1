# Nodes stored in other ways are hit as before; other forms than aabb have none.
cp "$ROOT/samples/scenes/torus.ply" .
bvh-build torus.ply -o torus.bvhx
trace() { bvh-trace torus.bvhx --rays diffuse --count 2000 --repeat 1 --format json "$@"; }
trace --hits plain.hits >plain.json
for storage in pairs record soa16-8 soa32-24; do
    trace --node-storage $storage --hits $storage.hits --cache 4K:64:8 >$storage.json
    cmp plain.hits $storage.hits
    trace --node-storage $storage --any-hit | json hits
    json node_storage bytes.nodes <$storage.json
done
python3 -c '
import json
stored = [json.load(open(name + ".json")) for name in ("plain", "pairs", "record", "soa16-8", "soa32-24")]
for key in ("hits", "NC", "LC", "TC", "AOC", "LCV"):
    print(key, len(set(report[key] for report in stored)) == 1)
print([round((report["records"] - 1) / stored[2]["records"]) for report in stored])'
bvh-compress torus.bvhx --form ssh -o ssh.bvhx
code bvh-trace ssh.bvhx --node-storage record
code trace --node-storage soa
