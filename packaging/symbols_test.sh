#!/usr/bin/env bash
# The shared libraries export the functions of bvhio.h and nothing else, and the reader needs none of the heavy libraries.
# Usage: symbols_test.sh LIBBVHIO.so LIBBVHIO-READ.so HEADER
set -uo pipefail
failed=0
exported() { nm -D --defined-only "$1" | awk '$2 != "A" { print $3 }' | sed 's/@.*//' | sort -u; }
declared=$(grep -oE '\bbvhio[A-Z][A-Za-z]*\(' "$3" | tr -d '(' | sort -u)

for library in "$1" "$2"; do
    strange=$(exported "$library" | grep -v '^bvhio[A-Z]')
    [ -z "$strange" ] || { echo "$library exports what is not its interface:"; echo "$strange"; failed=1; }
done
missing=$(comm -13 <(exported "$1") <(echo "$declared"))
[ -z "$missing" ] || { echo "$1 does not export:"; echo "$missing"; failed=1; }
unwanted=$(readelf -d "$2" | grep NEEDED | grep -E 'draco|png|tbb|meshoptimizer')
[ -z "$unwanted" ] || { echo "$2 needs:"; echo "$unwanted"; failed=1; }
exit $failed
