# The same bytes for any number of threads, and absurd numbers mean all.
grid 150 >grid.obj
for threads in 1 2 100000; do
    bvh-build grid.obj -j $threads | bvh-relayout -j $threads | bvh-compress -j $threads >$threads.bvhx
    bvh-trace $threads.bvhx -j $threads --rays diffuse --count 5000 --hits $threads.hits --format json |
        json rays hits hit_hash NC TC >$threads.txt
done
cmp 1.bvhx 2.bvhx
cmp 1.bvhx 100000.bvhx
cmp 1.hits 2.hits
cmp 1.txt 2.txt
cmp 1.txt 100000.txt
