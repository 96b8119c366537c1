# Clusters go through a pipe beside the tree, until something changes it; 8-byte records keep them.
grid 40 | bvh-build --max-leaf-size 1 -o grid.bvhx
chunks() { bvh-stats - --chunks | awk '{ print $1 }' | tr '\n' ' '; echo; }
bvh-relayout grid.bvhx --layout clusters --pointer-bits 6 --report report.json -o clusters.bvhx
json options.pointer-bits options.line-size order.record_bytes clusters.records clusters.clusters <report.json
keys report.json clusters.glue_share clusters.padding_share clusters.fill clusters.bytes_per_record
bvh-stats clusters.bvhx --no-epo --format json | json layout
bvh-stats clusters.bvhx --check
chunks <clusters.bvhx
bvh-stats grid.bvhx --diff clusters.bvhx | grep verdict
bvh-compress clusters.bvhx --form quantized-short --codec none -o short.bvhx
bvh-stats short.bvhx --check
bvh-stats short.bvhx --no-epo --format json | json form references bytes.nodes
bvh-compress clusters.bvhx --form quantized --bits 5 | bvh-stats - --no-epo --format json | json form
bvh-compress clusters.bvhx --form quantized --bits 6 | bvh-stats - --no-epo --format json | json form
bvh-compress grid.bvhx --form quantized --bits 6 | bvh-stats - --no-epo --format json | json form
# The same clusters come back: whole, as they were, and from 8-byte records with the boxes that those bound.
bvh-compress clusters.bvhx --codec topology -o topology.bvhx
chunks <topology.bvhx
bvh-compress topology.bvhx --form quantized-short | bvh-stats - --diff short.bvhx | grep verdict
bvh-compress short.bvhx --form aabb | bvh-compress --form quantized-short --codec none | bvh-stats - --diff short.bvhx | grep verdict
bvh-relayout short.bvhx | chunks
bvh-restructure clusters.bvhx | chunks
# Others get clusters of the defaults.
bvh-compress grid.bvhx --form quantized-short -v -o default.bvhx 2>&1 | grep -o 'put in clusters'
bvh-trace default.bvhx --rays random --count 1000 --compare short.bvhx >/dev/null
code bvh-compress grid.bvhx --form quantized-short --bits 6 -o no.bvhx
code bvh-compress grid.bvhx --record-bytes 8 -o no.bvhx
code bvh-compress grid.bvhx --form quantized-short --codec topology -o no.bvhx
code bvh-relayout grid.bvhx --layout clusters --pointer-bits 11 -o no.bvhx
code bvh-relayout grid.bvhx --layout clusters --record-bytes 8 -o no.bvhx
ls
