# Each option that --help knows is on the tool's page, and each on the page is known; likewise the names that options take.
for tool in build restructure relayout compress trace stats; do
    page=$ROOT/tools/bvh-$tool.md
    bvh-$tool --help | sed -n '/^Examples:/,$d; s/^  \(-[^ ]*\).*/\1/p' | tr ',' '\n' | sort -u >help
    grep -o '^- `-[^`]*`' "$page" | tr -d '`,' | tr ' ' '\n' | grep '^-.' | sort -u >page
    diff --label "bvh-$tool --help" --label "bvh-$tool.md" -u help page
    bvh-$tool --help | sed -n '/^Examples:/,$d; s/^ \{36\}\([a-z0-9-]\{1,\}\)  .*/\1/p' | while read -r name; do
        grep -q -- "\`$name\`" "$page" || echo "bvh-$tool.md does not have the name $name"
    done
done
