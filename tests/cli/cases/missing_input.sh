code bvh-build none.obj
code bvh-restructure none.bvhx
code bvh-relayout none.bvhx
code bvh-compress none.bvhx
code bvh-trace none.bvhx
code bvh-stats none.bvhx
cube | bvh-build -o cube.bvhx
code bvh-trace cube.bvhx --rays none.rays
code bvh-trace cube.bvhx --compare none.bvhx
code bvh-stats cube.bvhx --diff none.bvhx
