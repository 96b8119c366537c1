# Points, lines, skins, morph targets and cameras are not read: that is said on standard error and counted in the report.
base64 -d >triangle.bin <<<"AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
gltf '{"mesh": 0, "skin": 0}, {"mesh": 1}, {"mesh": 2}, {"camera": 0}' '
    {"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}, {"POSITION": 0}]}]},
    {"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}, {"attributes": {"POSITION": 0}, "mode": 3}]},
    {"primitives": [{"attributes": {}}]},
    {"primitives": [{"attributes": {"POSITION": 0}}]}' >posed.gltf
bvh-build posed.gltf --report posed.json -o posed.bvhx
json left_out read <posed.json
bvh-build posed.gltf -v -o posed.bvhx 2>&1 | grep -v ' s$'
bvh-build posed.gltf -q -o posed.bvhx
bvh-build posed.gltf --two-level -o posed.bvhx
# A camera alone is no loss; it is mentioned with -v.
gltf '{"mesh": 0}, {"camera": 0}' '{"primitives": [{"attributes": {"POSITION": 0}}]}' >camera.gltf
bvh-build camera.gltf -o camera.bvhx
bvh-build camera.gltf -v -o camera.bvhx 2>&1 | grep -v ' s$'
# Elements of other files.
{ cube; printf 'p 1\np 2\nl 1 2 3\n'; } | bvh-build --report obj.json -o obj.bvhx
json left_out.points left_out.lines <obj.json
ply 'element edge 1\nproperty int vertex1\nproperty int vertex2\n' '0 1\n' | bvh-build -o ply.bvhx
printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >lines.obj
code bvh-build lines.obj -o lines.bvhx
