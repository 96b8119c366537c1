#!/usr/bin/env bash
# Checks that two builds of the tools write the same bytes: containers of every builder, restructurer, layout, form and codec, and hits of
# every ray set, over the sample scenes. Also compares one thread with all threads. Usage: same_bytes.sh TOOLS_DIRECTORY OTHER_TOOLS_DIRECTORY
set -euo pipefail

first=$(realpath "$1") second=$(realpath "$2")
scenes=$(cd "$(dirname "$0")/.." && pwd)/samples/scenes
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT

# Prints the names that an option takes, from the tool's own help, so that new rows of tables are tested automatically.
choices() { # TOOL OPTION
    "$first/$1" --help | awk -v option="$2" '
        $1 == option { listing = 1; next }
        !/^            / { listing = 0 }
        listing && match($0, /^ */) && RLENGTH == 36 { print $1 }' # what is further right goes on with a summary
}

run() { # TOOLS THREADS OUTPUT
    local tools=$1 threads=$2 output=$3 scene name
    mkdir -p "$output"
    for scene in "$scenes"/*.{obj,ply,stl,glb,gltf,drc}; do
        [ -e "$scene" ] || continue
        name=$output/$(basename "$scene")
        for builder in "${builders[@]}"; do
            "$tools/bvh-build" "$scene" --two-level --builder "$builder" -j "$threads" -o "$name.levels.$builder.bvhx"
        done
        "$tools/bvh-restructure" "$name.levels.${builders[0]}.bvhx" -j "$threads" -o "$name.levels.restructured.bvhx"
        "$tools/bvh-compress" "$name.levels.restructured.bvhx" --form two-level -j "$threads" -o "$name.levels.compact.bvhx"
        "$tools/bvh-trace" "$name.levels.compact.bvhx" --rays diffuse --count 20000 -j "$threads" --hits "$name.levels.hits" >/dev/null
        [ "$(basename "$scene")" != orchard.glb ] || continue # tests instances only
        for builder in "${builders[@]}"; do
            "$tools/bvh-build" "$scene" --builder "$builder" -j "$threads" -o "$name.$builder.bvhx"
            for method in "${methods[@]}"; do
                "$tools/bvh-restructure" "$name.$builder.bvhx" --method "$method" -j "$threads" -o "$name.$builder.$method.bvhx"
            done
        done
        for layout in "${layouts[@]}"; do
            "$tools/bvh-relayout" "$name.${builders[0]}.bvhx" --layout "$layout" -j "$threads" -o "$name.$layout.bvhx"
        done
        for form in "${forms[@]}"; do
            for codec in "${codecs[@]}"; do
                [ "$codec" != topology ] || [ "$form" = aabb ] || continue # only this form's boxes can be refitted
                "$tools/bvh-compress" "$name.${builders[0]}.bvhx" --form "$form" --codec "$codec" --geometry raw \
                    -j "$threads" -o "$name.$form.$codec.bvhx"
            done
        done
        "$tools/bvh-compress" "$name.${builders[0]}.bvhx" --geometry draco -j "$threads" -o "$name.draco.bvhx"
        for rays in "${ray_sets[@]}"; do
            "$tools/bvh-trace" "$name.${builders[0]}.bvhx" --rays "$rays" --count 20000 -j "$threads" \
                --save-rays "$name.$rays.rays" --hits "$name.$rays.hits" >/dev/null
        done
    done
}

mapfile -t builders < <(choices bvh-build --builder)
mapfile -t methods < <(choices bvh-restructure --method)
mapfile -t layouts < <(choices bvh-relayout --layout)
mapfile -t forms < <(choices bvh-compress --form)
mapfile -t codecs < <(choices bvh-compress --codec)
mapfile -t ray_sets < <(choices bvh-trace --rays)
for list in builders methods layouts forms codecs ray_sets; do
    declare -n names=$list
    [ ${#names[@]} -gt 0 ] || { echo "same_bytes.sh: --help lists no $list"; exit 1; }
done

run "$first" 0 "$directory/first"
run "$first" 1 "$directory/one-thread"
run "$second" 0 "$directory/second"
diff -r "$directory/first" "$directory/one-thread" && diff -r "$directory/first" "$directory/second"
count=$(find "$directory/first" -type f | wc -l)
[ "$count" -gt 0 ] || { echo "same_bytes.sh: no scene found in $scenes"; exit 1; }
echo "$count files have the same bytes with one thread and with all, and from both builds"
