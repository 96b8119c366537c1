for tool in build restructure relayout compress trace stats; do
    bvh-$tool --version
done
