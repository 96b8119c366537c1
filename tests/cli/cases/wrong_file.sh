# Files of the wrong kind, and files in the wrong place, are refused with what to do instead.
cube >cube.obj
bvh-build cube.obj -o cube.bvhx
base64 -d >triangle.bin <<<"AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
gltf '{"mesh": 0}' '{"primitives": [{"attributes": {"POSITION": 0}}]}' >triangle.gltf
cp "$SAMPLES/scenes/orchard.glb" .
ply '' '' >triangle.ply
printf 'solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n' >triangle.stl
printf 'DRACO and more' >triangle.drc
# A scene where a container should be.
for tool in restructure relayout compress trace stats; do
    code bvh-$tool orchard.glb
done
for file in triangle.gltf cube.obj triangle.ply triangle.stl triangle.drc; do
    code bvh-stats $file
done
cp orchard.glb renamed.bvhx
code bvh-trace cube.bvhx --compare renamed.bvhx
cat orchard.glb | code bvh-stats
cat orchard.glb | code bvh-relayout
code bvh-trace <orchard.glb
# A container where a scene should be.
code bvh-build cube.bvhx -o again.bvhx
code bvh-build <cube.bvhx -o again.bvhx
# An option's name left out.
code bvh-build cube.obj out.bvhx
code bvh-relayout cube.bvhx out.bvhx
code bvh-stats cube.bvhx other.bvhx
code bvh-trace cube.bvhx other.bvhx
code bvh-trace cube.bvhx other.obj
# A picture of a kind that is not written: refused before the missing input is noticed.
code bvh-trace none.bvhx --image picture.exr
code bvh-trace none.bvhx --heatmap cost.jpg
bvh-trace cube.bvhx --resolution 8x6 --image PICTURE.PNG --heatmap /dev/null >table
[ ! -e picture.exr ] && [ ! -e cost.jpg ] && [ ! -e out.bvhx ] && [ ! -e again.bvhx ]
