# Names of files that are no UTF-8, hold spaces or begin with a dash: they end up in reports, which are JSON. Files that can't be looked at.
cube | bvh-build -o cube.bvhx
odd=$(printf 'a\377 b')
cube >"$odd.obj"
code bvh-build "$odd.obj" -o "$odd.bvhx" --report report.json
json tool <report.json
bvh-trace "$odd.bvhx" --count 100 --image "$odd.png" --hits "$odd.hits" --save-rays "$odd.rays" --format json >trace.json
json rays options.image <trace.json
bvh-trace "$odd.bvhx" --rays "$odd.rays" --format json >trace.json
json rays options.rays <trace.json
cp cube.bvhx -- -dash.bvhx
bvh-stats --no-epo -- -dash.bvhx | grep '^primitives'
ln -s loop loop
code bvh-stats loop
code bvh-stats cube.bvhx/inner
