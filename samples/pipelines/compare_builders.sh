#!/usr/bin/env bash
# Compares the costs of tracing two builders' trees: builds a scene with each, checks that both find the same hits, and prints
# their statistics. Usage: compare_builders.sh SCENE     (the tools must be on PATH)
set -euo pipefail

scene=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for builder in binned median; do
    bvh-build "$scene" --builder $builder -o "$work/$builder.bvhx"
done
bvh-trace "$work/binned.bvhx" --rays diffuse --count 100000 --compare "$work/median.bvhx" >"$work/compare"
echo "Both trees find the same hits."

for builder in binned median; do
    echo
    echo "$builder:"
    bvh-stats "$work/$builder.bvhx" --no-epo | grep -E '^(nodes|max_depth|sah_cost) '
    bvh-trace "$work/$builder.bvhx" --rays diffuse --count 100000 | grep -E '^(NC|TC|BLB|mrays_per_second) '
done
