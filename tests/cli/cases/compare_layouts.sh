# The script that puts layouts beside each other: a row for each in every table, and dfs beside itself.
grid 12 >grid.obj
echo "The text above <!-- compare_layouts.py writes what follows -->" >page.md
code python3 "$ROOT/samples/pipelines/compare_layouts.py" --rays 200 --repeat 1 --rounds 1 --layouts bfs --table page.md grid=grid.obj
head -n 1 page.md
grep '^## ' page.md
grep -c '^| bfs |' page.md
grep '^| dfs |' page.md | head -n 2
grep '^| record |' page.md | cut -d '|' -f 2,3
code python3 "$ROOT/samples/pipelines/compare_layouts.py" grid.obj 2>&1
