#!/usr/bin/env bash
# The completions offer every option of the tools, and every choice of an option. Other shells than bash only parse theirs, where
# they are installed. Usage: completions_test.sh COMPLETIONS_DIRECTORY TOOLS_DIRECTORY
set -uo pipefail
made=$1 tools=$2
failed=0

# What bash offers for a line of words, of which the last is being typed.
offers() { # TOOL WORD...
    local tool=$1
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
    "_${tool//-/_}"
    echo "${COMPREPLY[*]}"
}

expect() { # WANTED TOOL WORD...
    local wanted=$1 got
    shift
    got=$(offers "$@")
    [ "$got" = "$wanted" ] || { echo "$*: offers '$got', not '$wanted'"; failed=1; }
}

has() { # FILE TEXT
    grep -q -- "$2" "$1" || { echo "$1: has no '$2'"; failed=1; }
}

for tool in bvh-build bvh-restructure bvh-relayout bvh-compress bvh-trace bvh-stats; do
    . "$made/bash/$tool" || exit 1
    # Every word of --help that looks like an option at the head of a line.
    options=$("$tools/$tool" --help | awk '/^  -/ { gsub(/,/, " ", $1); printf "%s%s", sep, $1; sep = " " }')
    expect "$options" "$tool" -
    for option in $options; do
        plain=${option#-}
        plain=${plain#-}
        has "$made/bash/$tool" "$option"
        has "$made/zsh/_$tool" "$option"
        has "$made/fish/$tool.fish" " $plain"  # after -l or -s
    done
    ! command -v zsh >/dev/null || zsh -n "$made/zsh/_$tool" || failed=1
    ! command -v fish >/dev/null || fish -n "$made/fish/$tool.fish" || failed=1
done

expect "binned" bvh-build --builder bin
expect "binned" bvh-build --builder = bin
expect "table json" bvh-stats --format ""
expect "always" bvh-trace -v --progress al
expect "--builder" bvh-build --bu
expect "" bvh-build --bins ""
cd "$(mktemp -d)" && touch scene.glb && trap 'rm -r "$PWD"' EXIT
expect "scene.glb" bvh-build sc
expect "scene.glb" bvh-build -o sc
# Names of builders stand two columns to the right of the option's help.
builders=$("$tools/bvh-build" --help | awk '
    $1 == "--builder" { on = 1; column = index($0, $3) + 2; next }
    /^  -/ { on = 0 }
    on && substr($0, 1, column - 1) ~ /^ +$/ && substr($0, column, 1) != " " { printf "%s%s", sep, $1; sep = " " }')
expect "$builders" bvh-build --builder ""
exit $failed
