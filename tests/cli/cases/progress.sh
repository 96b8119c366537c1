# Silence by default and with -q; with -v what was read, and stages. Work of less than a second shows no progress.
cube >cube.obj
bvh-build cube.obj -o cube.bvhx --progress always
bvh-build cube.obj -o cube.bvhx -q
bvh-build cube.obj -o cube.bvhx -v 2>&1 | sed 's/[0-9.]* s$/N s/'
{ cube; sleep 1.5; } | bvh-build -o cube.bvhx --progress always
