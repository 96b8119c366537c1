# The same bytes through a pipe, to a file, to a file through a link, and through every kind of input.
cube >cube.obj
bvh-build cube.obj >piped.bvhx
bvh-build cube.obj -o file.bvhx
ln -s target.bvhx link.bvhx
touch target.bvhx
bvh-build cube.obj --output link.bvhx
bvh-build - <cube.obj >dash.bvhx
bvh-build <cube.obj >nothing.bvhx
cmp piped.bvhx file.bvhx
cmp piped.bvhx target.bvhx
cmp piped.bvhx dash.bvhx
cmp piped.bvhx nothing.bvhx
bvh-build cube.obj -o /dev/null
[ -L link.bvhx ] && ls
