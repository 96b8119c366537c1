# Findings are numbered, and an error among them is exit 7, also where a summary would be exit 3; a damaged chunk is still listed.
cube | bvh-build -o cube.bvhx
code bvh-stats cube.bvhx --check
code bvh-stats "$ROOT/tests/malformed/3003-shared_children.bvhx" --check
code bvh-stats - <"$ROOT/tests/malformed/3003-shared_children.bvhx"
code bvh-stats --check --format json <"$ROOT/tests/malformed/4004-nan_vertex.bvhx"
code bvh-stats --chunks <"$ROOT/tests/malformed/1016-payload_checksum.bvhx"
