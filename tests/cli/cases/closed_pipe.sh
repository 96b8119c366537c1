# Nobody reads on: one line and exit 2, not a signal. The output is far larger than a pipe holds.
grid 100 >grid.obj
bvh-build grid.obj -o grid.bvhx
bvh-build grid.obj | head -c 10 >/dev/null
echo "${PIPESTATUS[0]}"
bvh-relayout grid.bvhx | head -c 10 >/dev/null
echo "${PIPESTATUS[0]}"
