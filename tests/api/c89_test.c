/* From strict C89: the header compiles, structs have their documented sizes, and a triangle is built, saved,
 * opened and hit. */
#include <stdio.h>
#include <string.h>

#include "api/bvhio.h"

#define CHECK(condition)                                                         \
    do {                                                                         \
        if (!(condition)) {                                                      \
            printf("line %d: %s: %s\n", __LINE__, #condition, bvhioLastError()); \
            return 1;                                                            \
        }                                                                        \
    } while (0)

int main(void) {
    static const float vertices[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const uint32_t indices[3] = {0, 1, 2};
    const char* options[] = {"builder=median", NULL};
    BvhioSceneArrays arrays;
    BvhioScene* scene = NULL;
    BvhioContainer *built = NULL, *opened = NULL;
    BvhioTracer* tracer = NULL;
    BvhioRay ray;
    BvhioHit hit;
    uint32_t primitive = 7;
    void* bytes = NULL;
    size_t size = 0;

    CHECK(sizeof(BvhioNode) == 32 && sizeof(BvhioRay) == 32 && sizeof(BvhioHit) == 24);
    CHECK(bvhioVersion() == BVHIO_VERSION);

    memset(&arrays, 0, sizeof arrays);
    arrays.vertices = vertices;
    arrays.vertexCount = 3;
    arrays.indices = indices;
    arrays.triangleCount = 1;
    CHECK(bvhioCreateScene(&arrays, &scene) == BVHIO_OK);
    CHECK(bvhioBuild(scene, options, NULL, &built) == BVHIO_OK);
    CHECK(bvhioSaveMemory(built, NULL, &bytes, &size) == BVHIO_OK);
    CHECK(bvhioOpenMemory(bytes, size, 0, NULL, &opened) == BVHIO_OK);
    CHECK(bvhioCreateTracer(opened, 0, NULL, &tracer) == BVHIO_OK);

    memset(&ray, 0, sizeof ray);
    ray.origin[0] = ray.origin[1] = 0.25f;
    ray.origin[2] = 2;
    ray.direction[2] = -1;
    ray.tMax = 10;
    CHECK(bvhioTraceRay(tracer, &ray, &hit, &primitive) == 1);
    CHECK(hit.t == 2 && primitive == 0 && hit.geometry == 0 && hit.primitive == 0 && hit.instance == 0);
    ray.tMax = 1;
    CHECK(bvhioTraceRay(tracer, &ray, &hit, NULL) == 0 && hit.primitive == BVHIO_NOTHING);

    bvhioClose(built);
    CHECK(bvhioOpenMemory(bytes, size - 64, 0, NULL, &built) == BVHIO_INVALID);
    CHECK(built == NULL && bvhioLastFinding() == 1010);
    bvhioDestroyTracer(tracer);
    bvhioClose(opened);
    bvhioDestroyScene(scene);
    bvhioFree(bytes);
    return 0;
}
