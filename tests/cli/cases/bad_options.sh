cube | bvh-build -o cube.bvhx
cube >cube.obj
code bvh-build cube.obj --builder medain
code bvh-build cube.obj --bin 3
code bvh-build cube.obj --bins=x
code bvh-build cube.obj --bins -3
code bvh-build cube.obj --bins 4294967296
code bvh-build cube.obj --max-leaf-size 0
code bvh-build cube.obj --max-leaf-size 3 --max-leaf-size 0
code bvh-build cube.obj --traversal-cost nan
code bvh-build cube.obj --max-leaf-size
code bvh-build cube.obj --zzzzzzzz
code bvh-build cube.obj another.obj
code bvh-build cube.obj -q -v
code bvh-build cube.obj --report -
code bvh-build cube.obj -j -1
code bvh-build cube.obj -j many
code bvh-build cube.obj --builder sweep --bins 8
code bvh-build cube.obj --split-budget 0.1
code bvh-restructure cube.bvhx --method best
code bvh-restructure cube.bvhx --treelet-size 5
code bvh-restructure cube.bvhx --method reinsertion --gamma 0
code bvh-restructure cube.bvhx --method none --iterations 3
code bvh-restructure cube.bvhx --method none --no-collapse
code bvh-restructure cube.bvhx --method tr --no-collapse --max-leaf-size 2
code bvh-relayout cube.bvhx --layout dsf
code bvh-relayout cube.bvhx --layout bfs --threshold 0.5
code bvh-compress cube.bvhx --codec zsdt
code bvh-compress cube.bvhx --codec none --level 3 -o none.bvhx
code bvh-compress cube.bvhx --geometry rew
code bvh-compress cube.bvhx --form ssh --codec topology
code bvh-compress cube.bvhx --form ssh --bits 6
code bvh-compress cube.bvhx --form quantized --bits 9
code bvh-trace cube.bvhx --resolution 64
code bvh-trace cube.bvhx --camera here
code bvh-trace cube.bvhx --rays prinary
code bvh-trace cube.bvhx --rays random --heatmap cost.png
code bvh-trace cube.bvhx --count 0
code bvh-trace cube.bvhx --image picture.png --heatmap ./picture.png
code bvh-trace cube.bvhx --image -
code bvh-build cube.obj -o built.bvhx --report built.bvhx
code bvh-trace - --compare - <cube.bvhx
code bvh-stats --diff - <cube.bvhx
code bvh-stats cube.bvhx --format xml
ls
