# Builders and forms find the same hits; another scene does not.
grid 20 | bvh-build --builder median -o median.bvhx
grid 20 | bvh-build | bvh-compress -o other.bvhx
grid 20 | sed 's/^v 7 /v 7.25 /' | bvh-build -o moved.bvhx
for rays in primary random; do
    code bvh-trace median.bvhx --rays $rays --count 2000 --compare other.bvhx --format json >same
    tail -n 1 same
    code bvh-trace median.bvhx --rays $rays --count 2000 --compare moved.bvhx --format json >moved
    tail -n 1 moved
    head -n -1 moved | python3 -c '
import json, sys
compare = json.load(sys.stdin)["compare"]
print(compare["differing"] > 0, 0 < len(compare["first"]) <= 10, sorted(compare["first"][0]))'
done
