# A cost of -0 is one of 0: what one tool writes the others can read.
cube | bvh-build --traversal-cost -0 --intersection-cost -0 -o cube.bvhx
bvh-stats cube.bvhx --check
bvh-stats cube.bvhx --format json | json traversal_cost intersection_cost
