# The output may be the input, although that is mapped while the output is written.
grid 50 | bvh-build -o grid.bvhx
bvh-relayout grid.bvhx -o other.bvhx
bvh-relayout grid.bvhx -o grid.bvhx
cmp grid.bvhx other.bvhx
bvh-compress grid.bvhx -o grid.bvhx
bvh-stats grid.bvhx --check
ls
