/* Builds a tree over its own triangles, saves it in a compact form, opens the file and traces a ray through it.
 */
#include <bvhio.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { kSide = 64 };

/* A vertex as in many programs: the position is only a part of it. */
typedef struct Vertex {
    float position[3];
    float texture[2];
} Vertex;

static Vertex vertices[(kSide + 1) * (kSide + 1)];
static uint32_t indices[6 * kSide * kSide];

/* Hills over a square grid. */
static void makeHills(void) {
    uint32_t x, y, next = 0;
    for (y = 0; y <= kSide; ++y)
        for (x = 0; x <= kSide; ++x) {
            Vertex* v = &vertices[y * (kSide + 1) + x];
            v->position[0] = (float)x;
            v->position[1] = (float)y;
            v->position[2] = (float)(4 * sin(0.2 * x) * cos(0.3 * y));
            v->texture[0] = (float)x / kSide;
            v->texture[1] = (float)y / kSide;
        }
    for (y = 0; y < kSide; ++y)
        for (x = 0; x < kSide; ++x) {
            const uint32_t corner = y * (kSide + 1) + x, above = corner + kSide + 1;
            indices[next++] = corner;
            indices[next++] = corner + 1;
            indices[next++] = above;
            indices[next++] = corner + 1;
            indices[next++] = above + 1;
            indices[next++] = above;
        }
}

/* Called while a pass works. To cancel it, return 1. */
static int showProgress(void* user, uint64_t done, uint64_t total) {
    if (done == total) printf("%s is done\n", (const char*)user);
    return 0;
}

/* Builds the tree over the hills and saves it to `path`. */
static BvhioStatus save(const char* path) {
    const char* compressOptions[] = {"form=quantized", NULL};
    const char* buildOptions[] = {"builder=sweep", "max-leaf-size=2", NULL};
    BvhioContext context;
    BvhioSceneArrays arrays;
    BvhioScene* scene = NULL;
    BvhioContainer *built = NULL, *improved = NULL, *compact = NULL;
    BvhioStatus status;

    memset(&context, 0, sizeof context);
    context.program = "own_triangles";
    context.programVersion = "1.0";
    context.progress = showProgress;
    context.progressUser = "the build";

    memset(&arrays, 0, sizeof arrays);
    arrays.vertices = vertices;
    arrays.vertexCount = sizeof vertices / sizeof vertices[0];
    arrays.vertexStride = sizeof(Vertex);
    arrays.indices = indices;
    arrays.triangleCount = sizeof indices / sizeof indices[0] / 3;

    status = bvhioCreateScene(&arrays, &scene);
    if (status == BVHIO_OK) status = bvhioBuild(scene, buildOptions, &context, &built);
    context.progressUser = "the improvement";
    if (status == BVHIO_OK) status = bvhioRestructure(built, NULL, &context, &improved);
    if (status == BVHIO_OK) status = bvhioCompress(improved, compressOptions, NULL, &compact);
    if (status == BVHIO_OK) status = bvhioSaveFile(compact, path, NULL);
    bvhioClose(compact);
    bvhioClose(improved);
    bvhioClose(built);
    bvhioDestroyScene(scene);
    return status;
}

/* Traces a ray from above to the middle of the scene in `path`. */
static BvhioStatus shoot(const char* path) {
    BvhioContainer* container = NULL;
    BvhioTracer* tracer = NULL;
    const BvhioRay ray = {{32.3f, 32.6f, 100}, 0, {0, 0, -1}, 1000};
    BvhioHit hit;
    uint32_t triangle;
    BvhioStatus status = bvhioOpenFile(path, 0, NULL, &container);
    if (status == BVHIO_OK) status = bvhioCreateTracer(container, 0, NULL, &tracer);
    if (status == BVHIO_OK) {
        if (bvhioTraceRay(tracer, &ray, &hit, &triangle)) {
            /* The ids of a hit lead back to this program's own arrays. */
            const uint32_t* corners = &indices[3 * triangle];
            const float u = (1 - hit.u - hit.v) * vertices[corners[0]].texture[0] +
                            hit.u * vertices[corners[1]].texture[0] + hit.v * vertices[corners[2]].texture[0];
            printf("hit triangle %u at height %g, texture %g\n", (unsigned)triangle, 100 - (double)hit.t,
                   (double)u);
        } else {
            printf("miss\n");
        }
    }
    bvhioDestroyTracer(tracer);
    bvhioClose(container);
    return status;
}

int main(int argc, char** argv) {
    BvhioStatus status;
    if (argc != 2) {
        fprintf(stderr, "usage: own_triangles OUTPUT.bvhx\n");
        return 1;
    }
    makeHills();
    status = save(argv[1]);
    if (status == BVHIO_OK) status = shoot(argv[1]);
    if (status != BVHIO_OK) fprintf(stderr, "own_triangles: %s\n", bvhioLastError());
    return (int)status;
}
