# The keys that other programs read.
cube | bvh-build -o cube.bvhx
bvh-stats cube.bvhx --format json >stats.json
keys stats.json form layout primitives references nodes inner_nodes leaves max_depth sah_cost traversal_cost \
    intersection_cost epo bytes.file bytes.nodes bytes.primitives bytes.geometry stored_bytes bytes_per_primitive \
    version provenance topology_hash geometry_hash exact_sah_cost sah_ratio slack.total slack.mean slack.max slack.levels
bvh-stats cube.bvhx --check --format json >check.json
keys check.json findings
