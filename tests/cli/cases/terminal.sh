# Binary data never goes to a terminal, nor is it read from one.
cube >cube.obj
script -qec 'bvh-build cube.obj; echo exit $?' /dev/null </dev/null | tr -d '\r'
script -qec 'bvh-relayout -o out.bvhx; echo exit $?' /dev/null </dev/null | tr -d '\r'
script -qec 'bvh-build cube.obj -o /dev/tty; echo exit $?' /dev/null </dev/null | tr -d '\r'
ls
