# Every form is decoded to aabb, with the boxes that it bounds; passes over it work on the tree that it stands for.
grid 12 | bvh-build --builder sweep -o tree.bvhx
bvh-restructure tree.bvhx -o restructured.bvhx
bvh-compress tree.bvhx --form ssh -o direct.bvhx
stats() {
    for name in "$@"; do bvh-stats $name.bvhx --check --no-epo --format json >$name.json; done
}
stats tree restructured direct
for form in $(choices bvh-compress --form); do
    bvh-compress tree.bvhx --form "$form" -o compact.bvhx
    bvh-compress compact.bvhx --form aabb -o decoded.bvhx
    bvh-compress compact.bvhx --form ssh -o detour.bvhx
    bvh-relayout compact.bvhx -o relaid.bvhx
    bvh-restructure compact.bvhx -o again.bvhx
    bvh-restructure compact.bvhx --method none -o exact.bvhx
    stats compact decoded detour relaid again exact
    for name in relaid again; do
        bvh-trace $name.bvhx --rays random --count 2000 --compare tree.bvhx >/dev/null || echo "$form: $name has other hits"
    done
    python3 - "$form" <<'PYTHON'
import json, sys
form = sys.argv[1]
s = {name: json.load(open(name + ".json"))
     for name in "tree restructured direct compact decoded detour relaid again exact".split()}
def same(key, a, b):
    if s[a][key] != s[b][key]:
        print(f"{form}: {a} and {b} differ in {key}")
for name, stats in s.items():
    if stats["findings"]:
        print(f"{form}: {name} has findings")
for name in ("decoded", "relaid", "again", "exact"):
    same("form", name, "tree")
same("bounds_hash", "compact", "decoded")
same("bounds_hash", "decoded", "relaid")
if s["exact"]["slack"]["max"] != 1:
    print(f"{form}: not exact")
if s["compact"]["topology_hash"] == s["tree"]["topology_hash"]:
    same("bounds_hash", "tree", "exact")
    same("sah_cost", "restructured", "again")  # the same costs to judge by, so the same result
    same("bounds_hash", "direct", "detour")  # boxes do not grow twice
PYTHON
done
