# Binary data never goes to a terminal, nor is it read from one.
cube >cube.obj
script -qec 'bvh-build cube.obj; echo exit $?' /dev/null </dev/null | tr -d '\r'
script -qec 'bvh-relayout -o out.bvhx; echo exit $?' /dev/null </dev/null | tr -d '\r'
script -qec 'bvh-build cube.obj -o /dev/tty; echo exit $?' /dev/null </dev/null | tr -d '\r'
ls
# Tools that only wait in a pipe draw nothing on the terminal that they share.
bvh-build cube.obj -o cube.bvhx
script -qec '{ sleep 1.5; cat cube.bvhx; } | bvh-relayout | bvh-compress | bvh-stats --no-epo --format json -o stats.json' \
    /dev/null </dev/null | od -An -c
json primitives <stats.json
# A file without findings gets a line on a terminal, and none elsewhere.
script -qec 'bvh-stats cube.bvhx --check' /dev/null </dev/null | tr -d '\r'
bvh-stats cube.bvhx --check
