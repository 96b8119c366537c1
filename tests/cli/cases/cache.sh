# The cache model: its keys, the same numbers for any number of threads and however levels are given; what it is told, as a table.
cp "$ROOT/samples/scenes/torus.ply" .
bvh-build torus.ply -o torus.bvhx
trace() { bvh-trace torus.bvhx --rays diffuse --count 2000 --repeat 1 --format json "$@"; }
trace --cache 4K:64:8,32K:64:8 >levels.json
keys levels.json cache.hits cache.misses cache.bytes cache.nodes cache.primitives cache.indices cache.vertices cache.shared
trace --cache 4K:64:8 --cache 32K:64:8 -j 1 >again.json
trace --cache 4K:64:8+32K:64:8 >apart.json
trace --cache 4K:64:8 --ray-order shuffled >shuffled.json
python3 -c '
import json
cache = {name: json.load(open(name + ".json"))["cache"] for name in ("levels", "again", "apart", "shuffled")}
first, second = cache["levels"]["nodes"]
print(cache["levels"] == cache["again"], cache["apart"]["nodes"][0] == first, cache["apart"]["nodes"][1] == second)
print([first[key] for key in ("level", "fed_by")], [second[key] for key in ("level", "fed_by")])
print(second["hits"] + second["misses"] == first["misses"], cache["levels"]["misses"] == first["misses"])
print(first["bytes"] == 64 * first["misses"], cache["shuffled"]["misses"] > 2 * first["misses"])'
trace --ray-order shuffled --hits shuffled.hits >shuffled.json
trace --hits given.hits >given.json
cmp given.hits shuffled.hits

bvh-trace torus.bvhx --rays random --count 3 --fetches fetches.csv --cache 4K:64:8 --format json >trace.json
head -n 1 fetches.csv
python3 -c '
import csv, json
rows, cache = list(csv.DictReader(open("fetches.csv"))), json.load(open("trace.json"))["cache"]
print(sorted(set(row["ray"] for row in rows)), sum(row["array"] == "nodes" for row in rows) == cache["hits"] + cache["misses"])'

for cache in 32K 32K:64:0 32K:63:8 33000:64:8 1T:64:8 32K:64:2048 , 1K:64:1,1K:64:1,1K:64:1+1K:64:1+1K:64:1+1K:64:1+1K:64:1+1K:64:1+1K:64:1; do
    code trace --cache "$cache"
done
trace --cache 1024G:16:1024 | json cache.nodes | grep -o '"level": "[^"]*"'
