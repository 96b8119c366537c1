#!/usr/bin/env bash
# Other projects use the library in every way that it offers. Those that compile its sources are only planned, not built: that takes
# minutes. Usage: run.sh PREFIX (where the library is installed)
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
prefix=$(realpath "$1")
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
wanted=$(sed -n 's/^project(bvhio VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")

says_version() { # NAME COMMAND...
    local name=$1 got
    shift
    got=$("$@")
    [ "$got" = "$wanted" ] || { echo "$name: says version '$got', not '$wanted'"; return 1; }
    echo "$name: works"
}

for project in installed installed_static; do
    cmake -G Ninja -S "$here/$project" -B "$work/$project" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
    cmake --build "$work/$project" >/dev/null
    for program in uses reads; do says_version "$project, $program" "$work/$project/$program"; done
done

for project in add_subdirectory fetch_content; do
    cmake -G Ninja -S "$here/$project" -B "$work/$project" -DBVHIO_SOURCE="$root" >/dev/null
    ninja -C "$work/$project" -t commands uses >"$work/plan"
    ! grep -E 'bvh-build|_tests|libbvhio\.so' "$work/plan" || { echo "$project: builds tools, tests or what it does not link"; exit 1; }
    grep -q 'libbvhio\.a' "$work/plan" || { echo "$project: does not build the library"; exit 1; }
    ! cmake --build "$work/$project" --target help | grep -E 'bvh-|_tests' || { echo "$project: has tools or tests"; exit 1; }
    echo "$project: works"
done

PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name bvhio.pc)")
export PKG_CONFIG_PATH
for name in bvhio bvhio-read; do
    read -ra flags < <(pkg-config --cflags --libs $name)
    cc "$here/uses.c" "${flags[@]}" -o "$work/shared"
    says_version "$name.pc" env LD_LIBRARY_PATH="$(pkg-config --variable=libdir $name)" "$work/shared"
    read -ra flags < <(pkg-config --cflags --libs --static $name | sed "s, -l$name , -l:lib$name.a ,")
    cc "$here/uses.c" "${flags[@]}" -o "$work/static"
    says_version "$name.pc, static" "$work/static"
done
headers=$(cd "$prefix/include" && find . -type f | sort | tr '\n' ' ')
[ "$headers" = "./bvhio.h ./bvhio.hpp " ] || { echo "installed headers: $headers"; exit 1; }
