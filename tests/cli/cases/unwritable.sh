cube >cube.obj
code bvh-build cube.obj -o none/cube.bvhx
code bvh-build cube.obj -o cube.bvhx --report none/report.json
mkdir directory
code bvh-build cube.obj -o directory
chmod a-w directory
if [ "$(id -u)" -eq 0 ]; then # root may write there
    echo 'exit 2'
    echo 'bvh-build: directory/cube.bvhx: cannot be written: Permission denied' >&2
else
    code bvh-build cube.obj -o directory/cube.bvhx
fi
ls
