# The script that draws up the comparison of forms: a line for each candidate, and the papers' lines for scenes that they have.
grid 12 >grid.obj
echo "The text above <!-- compare_forms.py writes what follows -->" >page.md
code python3 "$ROOT/samples/pipelines/compare_forms.py" --rays 200 --repeat 1 --table page.md Buddha=grid.obj
head -n 1 page.md
grep '^## ' page.md
bvh-build grid.obj | bvh-compress --pareto table.csv --count 200 --repeat 1 -o grid.bvhx
tail -n +2 table.csv | while IFS=, read -r form parameters rest; do
    name=$form${parameters:+ $parameters}
    [ "$(grep -c "^| $name |" page.md)" = 4 ] || echo "$name: not in every table"
done
grep '^| Buddha |' page.md | cut -d '|' -f 3,4
code python3 "$ROOT/samples/pipelines/compare_forms.py" grid.obj 2>&1
