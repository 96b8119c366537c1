grid 20 | bvh-build -o grid.bvhx
bvh-trace grid.bvhx --resolution 80x60 --image image.png --heatmap cost.png >table
for picture in image.png cost.png; do
    head -c 8 $picture | od -An -tx1
done
