# The keys that other programs read in a pass' report.
cube | bvh-build -o cube.bvhx --report build.json
bvh-restructure cube.bvhx --report restructure.json >restructured.bvhx
bvh-relayout cube.bvhx --report relayout.json >relaid.bvhx
bvh-compress cube.bvhx --report compress.json >compressed.bvhx
for tool in build restructure relayout compress; do
    keys $tool.json sah_before sah_after seconds threads peak_bytes options
    json options <$tool.json
done
