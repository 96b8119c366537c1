# A stream that ends early is an error, at whichever byte, for every tool.
cube | bvh-build >cube.bvhx
size=$(stat -c %s cube.bvhx)
for tool in restructure relayout compress trace stats; do
    for cut in 1 20 100 500 $((size - 1)); do
        head -c "$cut" cube.bvhx | bvh-$tool >out 2>err
        echo "$? $(wc -l <err) line, $(wc -c <out) bytes"
    done
done | sort | uniq -c
