printf 'not a container, and long enough to be looked at for more than a header: %0200d' 0 >garbage.bvhx
for tool in restructure relayout compress trace stats; do
    code bvh-$tool garbage.bvhx
    code bvh-$tool </dev/null
done
printf 'not a scene' >garbage.obj
code bvh-build garbage.obj
code bvh-build </dev/null
