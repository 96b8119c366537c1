mkdir directory
for tool in build restructure relayout compress trace stats; do
    code bvh-$tool directory
done
