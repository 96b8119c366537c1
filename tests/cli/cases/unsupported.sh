# What a newer version may have written is told apart from damage, by name where there is one.
for file in 1003-major_2 1004-reader_1_1 2001-unknown_critical; do
    for tool in relayout trace stats; do
        code bvh-$tool "$ROOT/tests/malformed/$file.bvhx" 2>&1 | sed "s,$ROOT/,,"
    done
done
printf '{"asset": {"version": "2.0"}, "extensionsRequired": ["EXT_unheard_of"]}' >scene.gltf
code bvh-build scene.gltf
