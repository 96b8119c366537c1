#!/usr/bin/env bash
# Runs one command-line case: CASE.sh, in an empty directory with the tools on PATH and common.sh read, and compares its exit code
# and what it prints with CASE.exit (0 when there is none), CASE.stdout and CASE.stderr (empty when there are none).
# Usage: run_case.sh [--update] TOOLS_DIRECTORY CASE.sh    (--update writes what was seen as what is expected: read the diff)
set -uo pipefail

update=false
[ "$1" = --update ] && update=true && shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
case=$(realpath "${2%.sh}")
PATH=$(realpath "$1"):$PATH
export LC_ALL=C SAMPLES=$root/samples ROOT=$root

directory=$(mktemp -d)
trap 'chmod -R u+w "$directory"; rm -rf "$directory"' EXIT
mkdir "$directory/work"
cd "$directory/work" || exit 1

bash -c '. "$0"; . "$1"' "$here/common.sh" "$case.sh" </dev/null >../stdout 2>../stderr
code=$?

if $update; then
    rm -f "$case".{exit,stdout,stderr}
    [ $code -eq 0 ] || echo $code >"$case.exit"
    for stream in stdout stderr; do
        [ ! -s ../$stream ] || cp ../$stream "$case.$stream"
    done
    exit 0
fi

failed=0
expected=$(cat "$case.exit" 2>/dev/null || echo 0)
[ "$code" -eq "$expected" ] || { echo "exit code $code, expected $expected"; failed=1; }
for stream in stdout stderr; do
    wanted=$case.$stream
    [ -e "$wanted" ] || wanted=/dev/null
    diff -u --label "expected $stream" --label "$stream" "$wanted" ../$stream || failed=1
done
exit $failed
