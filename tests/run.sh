#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test. The one command for tests on a fresh Debian 12; takes minutes, since it
# builds three times: with g++, with clang and with sanitizers. Usage: tests/run.sh [STEP...]
# Steps: style, release, clang, sanitize and install, which no step stands for; quick, a first answer in minutes (style, and the fast
# tests of a release build); package, the Debian packages, installed in a fresh system (fetches one: needs root and a network).
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

steps=(style release clang sanitize install)
[ $# -eq 0 ] || steps=("$@")
jobs=$(nproc)
failed=()

# Runs a step's function; what it prints is shown as it comes. Functions join their commands with && to stop at the first failure.
step() {
    echo "== $1"
    local start=$SECONDS
    if "$1"; then
        echo "== $1: passed in $((SECONDS - start)) s"
    else
        echo "== $1: FAILED"
        failed+=("$1")
    fi
}

build() { # PRESET
    cmake --preset "$1" >/dev/null && cmake --build --preset "$1" -j "$jobs"
}

# Our files are formatted, scripts parse, includes point along the house's arrows, its picture is current, and links lead somewhere.
style() {
    git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run -Werror &&
        git ls-files '*.sh' | xargs -n 1 bash -n &&
        python3 tests/check_arrows.py &&
        python3 tests/draw_architecture.py --check &&
        python3 tests/check_links.py
}

# Every test, with the build that users run.
release() { build release && ctest --preset release -j "$jobs"; }

# clang's build writes the same bytes and finds the same hits as g++'s.
clang() { build release && build clang && bash tests/same_bytes.sh build/release/tools build/clang/tools; }

# The tests under the address and undefined-behaviour sanitizers.
sanitize() { build sanitize && ctest --preset sanitize -j "$jobs"; }

# What is installed can be found and used by other projects, samples/library among them.
install() {
    local prefix
    prefix=$(mktemp -d) &&
        build release && cmake --install build/release --prefix "$prefix" >/dev/null &&
        bash tests/consumers/run.sh "$prefix" &&
        cmake -G Ninja -S samples/library -B "$prefix/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release >/dev/null &&
        cmake --build "$prefix/build" &&
        "$prefix/bin/bvh-build" samples/scenes/courtyard.glb -o "$prefix/scene.bvhx" &&
        "$prefix/build/shoot" "$prefix/scene.bvhx" | grep '^hit at' &&
        "$prefix/build/shoot_cpp" "$prefix/scene.bvhx" | grep '^hit at' &&
        "$prefix/build/own_triangles" "$prefix/hills.bvhx" | grep '^hit triangle' &&
        "$prefix/build/own_traversal" "$prefix/hills.bvhx"
    local code=$?
    rm -rf "$prefix"
    return $code
}

# What most mistakes break, for the time between two changes.
quick() { style && build release && ctest --preset release -j "$jobs" --label-exclude slow; }

# The packages build, pass lintian, install in a fresh system and work there.
package() { bash samples/setup.sh package && build package && bash tests/package.sh build/package; }

bash samples/setup.sh build tests || exit 1
for name in "${steps[@]}"; do step "$name"; done

if [ ${#failed[@]} -gt 0 ]; then
    echo "FAILED: ${failed[*]}"
    exit 1
fi
echo "All tests passed: ${steps[*]}"
