#!/usr/bin/env bash
# Installs missing packages, builds the tools, runs all of them on a scene and shows the result. The one command to see the
# project work on a fresh Debian 12. Usage: quickstart.sh [SCENE]. The default is a sample scene.
set -euo pipefail
cd "$(dirname "$0")/.."

bash samples/setup.sh build
cmake --preset release -DBVHIO_BUILD_TESTS=OFF >/dev/null
cmake --build --preset release
export PATH=$PWD/build/release/tools:$PATH

scene=${1:-samples/scenes/courtyard.glb}
out=build/quickstart
mkdir -p "$out"

run() {
    printf '\n$ %s\n' "$1"
    eval "$1"
}
run "bvh-build '$scene' | bvh-restructure | bvh-relayout | bvh-compress -o $out/scene.bvhx"
run "bvh-stats $out/scene.bvhx"
run "bvh-stats $out/scene.bvhx --check && echo 'the file is valid'"
run "bvh-trace $out/scene.bvhx --image $out/scene.png --heatmap $out/heatmap.png"

printf '\nThe scene as its camera sees it:   %s\nThe cost of each pixel'"'"'s ray:      %s\n' "$PWD/$out/scene.png" "$PWD/$out/heatmap.png"
