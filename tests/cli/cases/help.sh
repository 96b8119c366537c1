# Every tool says what it is for, wherever --help stands; what --help lists is checked by manual_pages.
for tool in build restructure relayout compress trace stats; do
    bvh-$tool --help | sed -n 1p
    code bvh-$tool --nonsense --help | tail -n 1
done
