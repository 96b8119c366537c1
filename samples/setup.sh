#!/usr/bin/env bash
# Installs the packages that the project needs on Debian 12. This is the only list of packages; CMake finds each of them
# (libbvhio, tools, tests and tests/bench). Usage: samples/setup.sh [build] [tests] [package] [bench] [plots]. The default is build.
# Does nothing if all packages are installed. Needs root, or sudo, only if a package is missing.
set -euo pipefail

build=(
    g++ cmake ninja-build pkg-config
    libtbb-dev              # threads
    libhwy-dev              # SIMD chosen at run time
    libdraco-dev            # Draco meshes and geometry
    libtinygltf-dev         # glTF; its header includes the next one's
    nlohmann-json3-dev      # JSON: reports, glTF
    libmeshoptimizer-dev    # EXT_meshopt_compression
    libzstd-dev             # the zstd codec
    libxxhash-dev           # checksums
    libpng-dev              # images
    libcli11-dev            # command lines
    libspdlog-dev           # logs
    lowdown                 # manual pages from tools/bvh-*.md
)
tests=(
    git                     # lists files for the style check
    libgtest-dev
    clang clang-format libclang-rt-14-dev   # the second compiler, the format check, the fuzzers
    python3 python3-xxhash python3-zstandard  # the second reader of the format
)
package=(
    dpkg-dev fakeroot       # cpack: packages and what they depend on
    lintian                 # the check of packages
    debootstrap             # a fresh system to install them in
)
bench=(libembree-dev)       # the library with which benchmarks compare
plots=(python3 python3-matplotlib)  # samples/pipelines/compare_methods.py and compare_layouts.py --plot, plot_forms.py

wanted=()
for part in "${@:-build}"; do
    case "$part" in
        build) wanted+=("${build[@]}") ;;
        tests) wanted+=("${tests[@]}") ;;
        package) wanted+=("${package[@]}") ;;
        bench) wanted+=("${bench[@]}") ;;
        plots) wanted+=("${plots[@]}") ;;
        *) echo "setup.sh: unknown part '$part': use build, tests, package, bench or plots" >&2; exit 1 ;;
    esac
done

missing=()
for package in "${wanted[@]}"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

echo "Installing: ${missing[*]}" >&2
sudo=()
[ "$(id -u)" -eq 0 ] || sudo=(sudo)
"${sudo[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${sudo[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
