// Opens a .bvhx file, traces one ray through the middle of its scene from the front, and prints the hit.
#include <bvhio.hpp>
#include <cmath>
#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: shoot_cpp FILE.bvhx\n"), 1;
    try {
        const bvhio::Container container = bvhio::Container::open(argv[1]);
        const bvhio::Node& root = container.tree().nodes[0];

        bvhio::Ray ray{};
        for (int axis = 0; axis < 3; ++axis) ray.origin[axis] = 0.5f * (root.min[axis] + root.max[axis]);
        ray.origin[2] = 2 * root.max[2] - root.min[2];
        ray.direction[2] = -1;
        ray.tMax = INFINITY;

        const bvhio::Tracer tracer(container);
        bvhio::Hit hit;
        if (tracer.trace(ray, hit))
            std::printf("hit at t = %g: geometry %u, primitive %u, instance %u\n", hit.t, hit.geometry,
                        hit.primitive, hit.instance);
        else
            std::puts("miss");
    } catch (const bvhio::Error& error) {
        return std::fprintf(stderr, "shoot_cpp: %s\n", error.what()), int(error.status());
    }
}
