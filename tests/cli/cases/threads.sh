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
# The environment sets the number where -j does not; the report has the number that is really used.
threads() {
    bvh-trace 1.bvhx --count 100 --format json "$@" | json threads
}
BVHIO_THREADS=1 threads
BVHIO_THREADS=100000 threads -j 1
BVHIO_THREADS=many code bvh-stats 1.bvhx
taskset -c "$(taskset -pc $$ | sed 's/.*: //; s/[-,].*//')" bvh-trace 1.bvhx -j 8 --count 100 --format json | json threads
taskset -c "$(taskset -pc $$ | sed 's/.*: //; s/[-,].*//')" bvh-trace 1.bvhx --count 100 --format json | json threads
BVHIO_THREADS=1 bvh-build grid.obj --report report.json -o grid.bvhx
json threads <report.json
