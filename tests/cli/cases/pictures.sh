grid 20 | bvh-build -o grid.bvhx
bvh-trace grid.bvhx --resolution 80x60 --image image.png --heatmap cost.png >table
for picture in image.png cost.png; do
    head -c 8 $picture | od -An -tx1
done

# One scale for two pictures: equal costs get equal colours, whatever else is in the picture. The legend names the scale.
cube | bvh-build -o cube.bvhx
bvh-trace cube.bvhx --resolution 80x60 --heatmap first.png --heatmap-scale 40 >table
bvh-trace cube.bvhx --resolution 80x60 --heatmap again.png --heatmap-scale 40 >table
bvh-trace cube.bvhx --resolution 80x60 --heatmap other.png --heatmap-scale 80 >table
cmp first.png again.png && echo "the same scale, the same picture"
cmp -s first.png other.png || echo "another scale, another picture"
code bvh-trace cube.bvhx --heatmap-scale 40
code bvh-trace cube.bvhx --heatmap cost.png --heatmap-scale 0
