cube >cube.obj
touch out.bvhx
chmod 600 out.bvhx
bvh-build cube.obj -o out.bvhx
stat -c '%a' out.bvhx
