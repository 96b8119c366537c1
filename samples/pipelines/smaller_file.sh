#!/usr/bin/env bash
# Compares the sizes of a scene's container: plain, with zstd, and with zstd and Draco's lossy geometry. Checks that zstd changes
# no hits, and that Draco changes no t by more than a thousandth. Usage: smaller_file.sh SCENE     (tools on PATH)
set -euo pipefail

scene=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

bvh-build "$scene" -o "$work/plain.bvhx"
bvh-compress "$work/plain.bvhx" --form aabb --codec zstd -o "$work/zstd.bvhx"
bvh-compress "$work/plain.bvhx" --form aabb --codec zstd --geometry draco -o "$work/draco.bvhx"
for file in plain zstd draco; do
    printf '%-6s %10d bytes\n' $file "$(stat -c %s "$work/$file.bvhx")"
done

bvh-stats "$work/plain.bvhx" --diff "$work/zstd.bvhx" | grep verdict
bvh-trace "$work/plain.bvhx" --compare "$work/zstd.bvhx" >"$work/table" && echo "zstd: the same hits"
bvh-trace "$work/plain.bvhx" --compare "$work/draco.bvhx" --tolerance 0.001 | grep differing ||
    echo "draco: this many rays differ by more, at the edges of triangles"
