# The keys that other programs read in a pass' report.
cube | bvh-build -o cube.bvhx --report build.json
bvh-restructure cube.bvhx --report restructure.json >restructured.bvhx
bvh-relayout cube.bvhx --report relayout.json >relaid.bvhx
bvh-compress cube.bvhx --report compress.json >compressed.bvhx
for tool in build restructure relayout compress; do
    keys $tool.json sah_before sah_after seconds threads peak_bytes options
    [ $tool != relayout ] || keys $tool.json order.pairs order.moved order.record_bytes order.line_bytes order.page_bytes \
        order.lines order.pages order.line_changes.before order.line_changes.after order.page_changes.before order.page_changes.after
    [ $tool != restructure ] || keys $tool.json iterations bytes_per_node
    json options <$tool.json
done
# Of the tree as written: its boxes follow the rounded vertices.
grid 20 | bvh-build | bvh-compress --geometry draco --position-bits 4 -o rough.bvhx --report rough.json
reported=$(json sah_after <rough.json | cut -d ' ' -f 2)
written=$(bvh-stats rough.bvhx --no-epo --format json | json sah_cost | cut -d ' ' -f 2)
[ "$reported" = "$written" ] || echo "sah_after $reported, but the file has $written"
