# Without --form a compact file was decoded to boxes: full boxes become quantized, and what is compact stays what it is.
grid 12 | bvh-build -o grid.bvhx
bvh-compress grid.bvhx | bvh-stats --no-epo --format json | json form
for form in $(choices bvh-compress --form); do
    [ "$form" != aabb ] || continue
    bvh-compress grid.bvhx --form $form --codec none -o $form.bvhx
    bvh-compress $form.bvhx -o small.bvhx
    bvh-stats $form.bvhx --diff small.bvhx | grep verdict
done
bvh-compress quantized.bvhx --bits 5 | bvh-compress --codec none | bvh-stats --no-epo --format json | json form
bvh-compress mvh.bvhx --leaf-size 1 | bvh-stats --no-epo --format json | json form leaves
bvh-compress grid.bvhx --codec topology | bvh-stats --no-epo --format json | json form
code bvh-compress ssh.bvhx --leaf-size 2 -o no.bvhx
