# The keys that other programs read.
cube | bvh-build -o cube.bvhx
bvh-trace cube.bvhx --count 100 --format json >trace.json
keys trace.json rays hits hit_hash NC LC TC AOC BLB LCV mrays_per_second threads seconds processor_seconds bytes.nodes bytes.primitives \
    bytes.geometry
for metric in LJC CMC WSS; do
    keys trace.json $metric.128 $metric.512 $metric.4096 $metric.16384 $metric.131072
done
