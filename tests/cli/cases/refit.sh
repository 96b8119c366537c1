# The tree of a container, fitted to its mesh in another pose: the hits are those of a tree built anew, in every form.
grid 12 >grid.obj
awk '/^v/ { $3 += sin($2 * $4) * 3; $2 *= 1.5 } { print }' grid.obj >moved.obj
bvh-build moved.obj -o anew.bvhx
for form in $(choices bvh-compress --form); do
    bvh-build grid.obj --builder sweep | bvh-compress --form "$form" -o old.bvhx
    bvh-build moved.obj --refit old.bvhx -o refitted.bvhx --report report.json
    bvh-stats refitted.bvhx --check
    bvh-trace refitted.bvhx --rays random --count 3000 --compare anew.bvhx >/dev/null || echo "$form: other hits"
    bvh-stats old.bvhx --no-epo --format json >old.json
    bvh-stats refitted.bvhx --no-epo --format json >refitted.json
    python3 - "$form" <<'PYTHON'
import json, sys
report, old, refitted = (json.load(open(name + ".json")) for name in ("report", "old", "refitted"))
for key, left, right in (("form", old["form"], refitted["form"]), ("topology", old["topology_hash"], refitted["topology_hash"]),
                         ("sah_before", report["sah_before"], old["sah_cost"]), ("sah_after", report["sah_after"], refitted["sah_cost"])):
    if left != right:
        print(f"{sys.argv[1]}: {key}: {left} and {right}")
for key in ("seconds", "threads", "peak_bytes", "options"):
    if key not in report:
        print(f"{sys.argv[1]}: no {key}")
PYTHON
done
# The history goes on.
json provenance <refitted.json | python3 -c '
import json, sys
for step in json.loads(sys.stdin.read().split(" ", 1)[1]):
    print(step["tool"], step["options"].get("refit", ""))'
# Through a pipe, either of the two; triangles that were dropped stay away.
cat moved.obj | bvh-build --refit old.bvhx | cmp - refitted.bvhx
cat old.bvhx | bvh-build --refit - moved.obj | cmp - refitted.bvhx
{ cube && echo 'f 1 1 2'; } >flat.obj
bvh-build flat.obj --on-degenerate drop | bvh-build flat.obj --refit - | bvh-stats --format json | json primitives
# Triangles and vertices in another order than the source's are found again.
bvh-build grid.obj | bvh-compress --triangle-order leaf --vertex-order use -o reordered.bvhx
bvh-build moved.obj --refit reordered.bvhx -o refitted.bvhx
bvh-stats refitted.bvhx --check
bvh-trace refitted.bvhx --rays random --count 3000 --compare anew.bvhx >/dev/null || echo "other hits"
# Boxes of split triangles become whole.
bvh-build grid.obj --builder spatial --split-budget 1 --intersection-cost 9 -o split.bvhx
bvh-build moved.obj --refit split.bvhx -o refitted.bvhx
bvh-stats refitted.bvhx --check

code bvh-build moved.obj --refit old.bvhx --bins 8 -o no.bvhx
code bvh-build --refit - -o no.bvhx <old.bvhx
code bvh-build moved.obj --refit moved.obj -o no.bvhx
grid 13 >other.obj
code bvh-build other.obj --refit old.bvhx -o no.bvhx
sed 's/^f 1 2 15$/f 1 3 15/' moved.obj >torn.obj
code bvh-build - --refit old.bvhx -o no.bvhx <torn.obj
[ ! -e no.bvhx ] || echo "no.bvhx was written"
