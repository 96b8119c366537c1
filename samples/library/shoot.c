/* Opens a .bvhx file, traces one ray through the middle of its scene from the front, and prints the hit.
 */
#include <bvhio.h>
#include <math.h>
#include <stdio.h>

/* Prints the library's last failure and returns its status, which is also the exit status of the program. */
static int fail(BvhioStatus status) {
    fprintf(stderr, "shoot: %s\n", bvhioLastError());
    return (int)status;
}

int main(int argc, char** argv) {
    BvhioContainer* container = NULL;
    BvhioTracer* tracer = NULL;
    BvhioTree tree;
    BvhioRay ray;
    BvhioHit hit;
    BvhioStatus status;
    int axis;

    if (argc != 2) {
        fprintf(stderr, "usage: shoot FILE.bvhx\n");
        return 1;
    }
    status = bvhioOpenFile(argv[1], 0, NULL, &container);
    if (status != BVHIO_OK) return fail(status);
    status = bvhioGetTree(container, 0, &tree);
    if (status == BVHIO_OK) status = bvhioCreateTracer(container, 0, NULL, &tracer);
    if (status != BVHIO_OK) {
        bvhioClose(container);
        return fail(status);
    }

    /* From in front of the root's box, towards -z. */
    for (axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = 0.5f * (tree.nodes[0].min[axis] + tree.nodes[0].max[axis]);
        ray.direction[axis] = 0;
    }
    ray.origin[2] = 2 * tree.nodes[0].max[2] - tree.nodes[0].min[2];
    ray.direction[2] = -1;
    ray.tMin = 0;
    ray.tMax = HUGE_VALF;

    if (bvhioTraceRay(tracer, &ray, &hit, NULL))
        printf("hit at t = %g: geometry %u, primitive %u, instance %u\n", (double)hit.t,
               (unsigned)hit.geometry, (unsigned)hit.primitive, (unsigned)hit.instance);
    else
        printf("miss\n");
    bvhioDestroyTracer(tracer);
    bvhioClose(container);
    return 0;
}
