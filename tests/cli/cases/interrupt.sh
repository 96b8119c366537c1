# A run that a signal ends leaves the old file whole and nothing beside it. The tool waits for its input meanwhile.
cube | bvh-build -o cube.bvhx
cp cube.bvhx old.bvhx
for signal in INT TERM HUP; do
    { cube; sleep 2; } | timeout --preserve-status -s $signal 0.5 bvh-build -o cube.bvhx --report report.json
    echo "${PIPESTATUS[1]}"
    cmp cube.bvhx old.bvhx
    ls -A
done
