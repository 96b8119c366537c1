// Loads a .bvhx file, shoots one ray through the middle of its scene from the front, and prints what it hits.
#include <array>
#include <cstdio>

#include "file/bvhx_file.h"
#include "trace/trace.h"

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: shoot FILE.bvhx\n"), 1;
    try {
        const bvhio::BvhxFile file = bvhio::readBvhx(argv[1]);
        const bvhio::Aabb bounds = bvhio::decode(file.bvh).nodes[0].bounds;

        bvhio::Ray ray;
        ray.origin = bounds.center();
        ray.origin.z = bounds.max.z + bounds.extent().z;
        ray.direction = {0, 0, -1};

        const bvhio::Tracer tracer(file.scene, file.bvh);
        std::array<bvhio::Hit, 1> hit;
        tracer.closestHits({&ray, 1}, hit);
        if (hit[0].isMiss()) return std::puts("miss"), 0;
        const auto id = file.scene.primitiveId(hit[0].primitive);
        std::printf("hit at t = %g: geometry %u, primitive %u\n", hit[0].t, id.geometry, id.primitive);
    } catch (const bvhio::Error& error) {
        return std::fprintf(stderr, "shoot: %s\n", error.what()), int(error.kind());
    }
}
