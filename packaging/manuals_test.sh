#!/usr/bin/env bash
# Each manual page names its program and has the sections that people look for. Usage: manuals_test.sh MANUALS_DIRECTORY
set -uo pipefail
failed=0
count=0
for page in "$1"/bvh-*.1; do
    tool=$(basename "$page" .1)
    count=$((count + 1))
    grep -qE "^$tool - [a-z].*[^.]$" "$page" || { echo "$page: has no line '$tool - SUMMARY'"; failed=1; }
    for section in NAME SYNOPSIS OPTIONS EXAMPLES; do
        grep -qx "$section" "$page" || { echo "$page: has no section $section"; failed=1; }
    done
done
[ $count = 6 ] || { echo "$count manual pages, not 6"; failed=1; }
exit $failed
