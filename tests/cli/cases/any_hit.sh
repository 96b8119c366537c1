# Any-hit queries find something exactly where closest-hit queries do.
grid 20 | bvh-build -o grid.bvhx
for rays in primary shadow ao diffuse random; do
    closest=$(bvh-trace grid.bvhx --rays $rays --count 2000 --format json | json hits)
    any=$(bvh-trace grid.bvhx --rays $rays --count 2000 --any-hit --format json | json hits)
    [ "$closest" = "$any" ] || echo "$rays: $closest closest, $any any"
done
