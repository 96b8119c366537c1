# What sets two files apart: nothing, or the costs, the topology, or the geometry.
grid 4 | bvh-build -o grid.bvhx
bvh-relayout grid.bvhx | bvh-compress --form aabb -o same.bvhx
grid 4 | bvh-build --builder median -o median.bvhx
grid 4 | bvh-build --builder median --intersection-cost 2 -o costs.bvhx
grid 5 | bvh-build -o larger.bvhx
for other in same median larger; do
    code bvh-stats grid.bvhx --diff $other.bvhx | grep -e verdict -e exit
done
code bvh-stats median.bvhx --diff costs.bvhx | grep -e verdict -e costs -e exit
