cube | bvh-build | bvh-restructure | bvh-relayout | bvh-compress | tee cube.bvhx | bvh-stats --provenance
bvh-stats cube.bvhx --check
bvh-trace cube.bvhx --rays primary --resolution 64x48 --format json | json rays hits options.rays
