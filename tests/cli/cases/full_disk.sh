cube >cube.obj
bvh-build cube.obj -o cube.bvhx
bvh-build cube.obj >/dev/full
echo "exit $?" >&2
code bvh-build cube.obj -o /dev/full
code bvh-restructure cube.bvhx -o /dev/full
code bvh-relayout cube.bvhx -o /dev/full
code bvh-compress cube.bvhx -o /dev/full
code bvh-build cube.obj -o ok.bvhx --report /dev/full
bvh-trace cube.bvhx --count 100 >/dev/full
echo "exit $?" >&2
bvh-stats cube.bvhx >/dev/full
echo "exit $?" >&2
bvh-stats --help >/dev/full
echo "exit $?" >&2
code bvh-trace cube.bvhx --count 100 --hits /dev/full
