# The report says how many rays --count became: sets that belong to pixels trace whole 4:3 pictures.
cube | bvh-build -o cube.bvhx
for rays in primary ao random; do
    bvh-trace cube.bvhx --rays $rays --count 1000 --format json >report.json
    python3 -c 'import json; r = json.load(open("report.json")); print([(k, r.get(k)) for k in ("rays", "rays_at_most", "resolution")])'
done
bvh-trace cube.bvhx --count 1000 | grep -E '^(rays|rays_at_most|resolution) '
bvh-trace cube.bvhx --resolution 20x10 --format json | json rays resolution
# The machine is named.
bvh-trace cube.bvhx --count 100 --format json >report.json
keys report.json cpu simd
bvh-trace cube.bvhx --count 100 | grep -cE '^(cpu|simd) '
