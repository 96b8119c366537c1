cube | bvh-build -o cube.bvhx
cp cube.bvhx old.bvhx
printf 'garbage' | code bvh-relayout -o cube.bvhx
cmp cube.bvhx old.bvhx
ls -A
