# Saved rays, traced again, give the same hits, in whichever order they are traced.
grid 20 | bvh-build -o grid.bvhx
bvh-trace grid.bvhx --rays diffuse --count 1000 --save-rays diffuse.rays --hits given.hits >table
for order in given morton shuffled; do
    bvh-trace grid.bvhx --rays diffuse.rays --ray-order $order --hits $order-again.hits >table
    cmp given.hits $order-again.hits
done
rays=$(bvh-trace grid.bvhx --rays diffuse.rays --format json | json rays | cut -d ' ' -f 2)
[ "$(stat -c %s diffuse.rays)" -eq $((16 + 32 * rays)) ] || echo 'ray file has another size'
[ "$(stat -c %s given.hits)" -eq $((16 + 24 * rays)) ] || echo 'hit file has another size'
head -c 8 diffuse.rays
head -c 8 given.hits
head -c 100 diffuse.rays >cut.rays
code bvh-trace grid.bvhx --rays cut.rays
