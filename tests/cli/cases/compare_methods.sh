# The script that draws up the comparison of methods: a row for each chain, over trees that find the same hits.
grid 12 >grid.obj
code python3 "$ROOT/samples/pipelines/compare_methods.py" --rounds 1 --rays 500 --chains binned,median+none grid.obj |
    sed -E 's/^\| ([a-z+ ]+) \|.*/\1/'
code python3 "$ROOT/samples/pipelines/compare_methods.py" --chains nosuch grid.obj 2>/dev/null
