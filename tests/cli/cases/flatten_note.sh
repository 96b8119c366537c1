# A scene whose instances multiply its triangles more than fourfold is mentioned, with what keeps it small.
base64 -d >triangle.bin <<<"AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
mesh='{"primitives": [{"attributes": {"POSITION": 0}}]}'
gltf '{"mesh": 0}, {"mesh": 0}, {"mesh": 0}, {"mesh": 0}' "$mesh" >four.gltf
gltf '{"mesh": 0}, {"mesh": 0}, {"mesh": 0}, {"mesh": 0}, {"mesh": 0}' "$mesh" >five.gltf
bvh-build four.gltf -o four.bvhx
bvh-build five.gltf -o five.bvhx
bvh-build five.gltf -q -o five.bvhx
bvh-build five.gltf --two-level -o five.bvhx
