# What the mvh form can be told: hits stay, other forms refuse it, and zetas are checked.
grid 12 | bvh-build -o grid.bvhx
for options in '' '--mvh-build paper' '--leaf-size 1' '--zeta 0.4' '--zeta 0.5,0.25 --leaf-size 16'; do
    bvh-compress grid.bvhx --form mvh $options -o mvh.bvhx
    bvh-stats mvh.bvhx --check
    bvh-trace mvh.bvhx --rays random --count 2000 --compare grid.bvhx >/dev/null || echo "$options: other hits"
done
bvh-compress grid.bvhx --form mvh -v -o mvh.bvhx 2>&1 | grep -o 'mvh builds.*'
# A tree of its own, which other forms take over.
bvh-compress mvh.bvhx --form aabb | bvh-stats --no-epo --format json | json form leaves
code bvh-compress grid.bvhx --leaf-size 2 -o no.bvhx
code bvh-compress grid.bvhx --form ssh --zeta auto -o no.bvhx
code bvh-compress grid.bvhx --form mvh --zeta 0.3,0.6 -o no.bvhx
code bvh-compress grid.bvhx --form mvh --zeta none -o no.bvhx
code bvh-compress grid.bvhx --form mvh --leaf-size 17 -o no.bvhx
[ ! -e no.bvhx ] || echo "no.bvhx was written"
