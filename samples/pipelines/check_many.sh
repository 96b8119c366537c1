#!/usr/bin/env bash
# Checks containers before they are published. Prints nothing if all are valid. Usage: check_many.sh FILE.bvhx...   (tools on PATH)
set -uo pipefail

bad=0
for file in "$@"; do
    bvh-stats "$file" --check -o /dev/stderr || { echo "$file: exit $?" >&2; bad=1; }
done
exit $bad
