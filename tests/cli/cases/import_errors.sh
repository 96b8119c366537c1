# Errors name the scene by the path that was given, and the file beside it that is at fault.
mkdir -p scenes/parts
printf '{"asset": {"version": "2.0"}, "nodes": 3}' >scenes/damaged.gltf
code bvh-build scenes/damaged.gltf
printf 'v 0 0\n' >scenes/damaged.obj
code bvh-build scenes/damaged.obj
printf 'v 0 0 0\nf 1 2 3\n' >scenes/index.obj
code bvh-build scenes/index.obj
printf 'hello' >scenes/damaged.ply
code bvh-build scenes/damaged.ply
gltf '{"mesh": 0}' '{"primitives": [{"attributes": {"POSITION": 0}}]}' >scenes/alone.gltf
code bvh-build scenes/alone.gltf
sed 's,triangle.bin,parts/triangle%20one.bin,' scenes/alone.gltf >scenes/deeper.gltf
code bvh-build scenes/deeper.gltf
# glTF 1.0 is named: with its version, without it, and as GLB.
printf '{"asset": {"version": "1.0"}, "meshes": {}}' >scenes/first.gltf
code bvh-build scenes/first.gltf
printf '{"meshes": {}, "nodes": {}}' >scenes/unnamed.gltf
code bvh-build scenes/unnamed.gltf
printf 'glTF\1\0\0\0\40\0\0\0\10\0\0\0\0\0\0\0{}          ' >scenes/first.glb
code bvh-build scenes/first.glb
printf '{"meshes": []}' >scenes/none.gltf
code bvh-build scenes/none.gltf
