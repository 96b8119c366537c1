# --help shows defaults, lists options with those that they belong to, and has none of the parser's own notation.
default_of() {
    "bvh-$1" --help | awk -v option="$2" '/^  -/ { on = $1 == option } on' | tr -s ' \n' ' ' |
        grep -o "(default[^)]*)" | head -1 | sed "s/^/$1 $2 /"
}
for option in --line-size --record-bytes --smoothing --threshold --pointer-bits --treelet-size --probability; do
    default_of relayout $option
done
default_of trace --resolution
default_of trace --rays
default_of trace --count
default_of build --max-leaf-size
default_of build -j,--threads
default_of stats -o,--output
bvh-restructure --help | grep -o -- '--collapse[^ ]*'
for tool in build restructure relayout compress trace stats; do
    bvh-$tool --help | grep '{false}'
    bvh-$tool --help | awk -v tool=$tool 'length > 110 { print tool ": " $0 }'
    bvh-$tool --help | sed -n '/^Input and output/,$d; s/^  \(--report\|--output\|--progress\).*/\1 is among the options/p'
done
# What belongs to bvh-compress' search stands with it, and a level has one range in --help and in its error.
bvh-compress --help | sed -n '/^Input and output/,$d; s/^  \(--pareto\|--max-slowdown\).*/\1/p'
bvh-compress --help | grep -A1 -- '^  --level' | tr -s ' \n' ' ' | grep -o 'compression level.*small)'
cube | bvh-build -o cube.bvhx
code bvh-compress cube.bvhx --level 20
