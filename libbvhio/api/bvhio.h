/* bvhio: reads, builds, improves, compresses, traces and writes bounding volume hierarchies (BVHs) in .bvhx
 * files.
 *
 * This header is the whole interface for C, and for every language that can call C. bvhio.hpp wraps it for
 * C++. The page libbvhio/api/README.md shows it in ten minutes.
 *
 * HANDLES. A BvhioContainer is a scene and its tree, from a file or made by a pass. A BvhioScene is a scene
 * alone. A BvhioTracer traces rays through a container. All three are immutable: a pass takes a container and
 * makes another. Containers share equal arrays, so a pass that reorders nodes copies no triangles. Close each
 * handle that a function gives you, once, in any order: a tracer keeps what it needs of its container.
 *
 * POINTERS that a function gives you belong to the handle that you passed, stay valid until that handle is
 * closed, and are read-only. Text is UTF-8 and ends with a zero byte. Arrays that you pass are copied, with
 * one exception: bvhioOpenMemory uses your bytes in place.
 *
 * THREADS. Any function may be called from any thread at any time, also on the same handle. The only exception
 * are the functions that close a handle: nobody else may still use it. The library has no global settings. For
 * functions that use several threads, each call states their maximum number.
 *
 * ERRORS. Functions return a BvhioStatus. If it is not BVHIO_OK, the function made nothing, sets the handles
 * that it would have given to NULL, and bvhioLastError says what is wrong, in one line. No C++ exception leaves
 * the library. A handle that you pass may be NULL only if the function's comment says so; otherwise the status
 * is BVHIO_USAGE.
 *
 * UNITS. Coordinates are 32-bit floats in the scene's own unit. Sizes are in bytes. Counts are in elements: a
 * vertex is three floats, a triangle three 32-bit indices. Costs are in the arbitrary unit of the surface
 * area heuristic (SAH).
 *
 * READER PART. Functions marked [reader] are in libbvhio-read, too: a smaller library without builders and
 * writers, which needs neither Draco, PNG, TBB nor meshoptimizer. There, files whose geometry is compressed
 * with Draco are BVHIO_UNSUPPORTED.
 *
 * Structs may grow only with the library's major version, the number in libbvhio.so.1.
 */
#ifndef BVHIO_H
#define BVHIO_H

#include <stddef.h>
#include <stdint.h>

/* Exported functions of the shared library. Users define nothing. */
#ifndef BVHIO_API
#if defined(__GNUC__)
#define BVHIO_API __attribute__((visibility("default")))
#else
#define BVHIO_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Enums can hold any int in C++ too, so that a wrong value is an error, not undefined behaviour. */
#ifdef __cplusplus
#define BVHIO_ANY_INT : int
#else
#define BVHIO_ANY_INT
#endif

/* ---- Version --------------------------------------------------------------- */

/* The version of this header. */
#define BVHIO_VERSION_MAJOR 0
#define BVHIO_VERSION_MINOR 1
#define BVHIO_VERSION_PATCH 0
#define BVHIO_VERSION (BVHIO_VERSION_MAJOR * 10000 + BVHIO_VERSION_MINOR * 100 + BVHIO_VERSION_PATCH)

/* [reader] The version of the library that runs, as a number like BVHIO_VERSION: compare the two. */
BVHIO_API uint32_t bvhioVersion(void);

/* [reader] The same as text, such as "0.1.0". Lives as long as the program. */
BVHIO_API const char* bvhioVersionText(void);

/* ---- Errors ---------------------------------------------------------------- */

/* How a function ended. Values 1 to 5 are the exit codes of the command-line tools. */
typedef enum BvhioStatus BVHIO_ANY_INT {
    BVHIO_OK = 0,
    BVHIO_USAGE = 1,       /* a wrong argument or option */
    BVHIO_IO = 2,          /* a missing file, a full disk, no permission */
    BVHIO_INVALID = 3,     /* damaged or meaningless data */
    BVHIO_RESOURCES = 4,   /* out of memory, or of threads */
    BVHIO_UNSUPPORTED = 5, /* valid data that this version cannot read or hold */
    BVHIO_CANCELLED = 6    /* your progress callback asked for it */
} BvhioStatus;

/* [reader] Why the last failed call on this thread failed: one line, without a full stop; "" if no call has
 * failed. Valid until the next failure on this thread. Messages over 1000 bytes are cut. */
BVHIO_API const char* bvhioLastError(void);

/* [reader] The number of the finding, if that failure was a numbered finding about a file; otherwise 0. The
 * page format-spec/diagnostics.md lists all findings. */
BVHIO_API uint32_t bvhioLastFinding(void);

/* [reader] A status as a word, such as "invalid". Lives as long as the program. */
BVHIO_API const char* bvhioStatusName(BvhioStatus status);

/* ---- How functions run ----------------------------------------------------- */

/* Receives the progress of a pass: `done` of `total`, in a unit that depends on the pass. `total` may change,
 * and is 0 while it is unknown. Return 0 to continue. Any other value cancels the pass, which ends soon after
 * with BVHIO_CANCELLED. The callback runs on threads of the pass: not always on the same thread, but one call at
 * a time. It must not call bvhio functions that take the same callback, and must not throw or jump out. */
typedef int (*BvhioProgress)(void* user, uint64_t done, uint64_t total);

/* How one call runs. A context of NULL means all zeros. */
typedef struct BvhioContext {
    uint32_t threads;       /* maximum number of threads, including yours; 0: all of the machine's */
    BvhioProgress progress; /* NULL: no progress is reported */
    void* progressUser;     /* the first argument of `progress` */
    const char* program; /* your program's name, for the history in files that it saves; NULL: "libbvhio" */
    const char* programVersion; /* NULL: "" with a program of your own */
} BvhioContext;

/* ---- Opening containers ---------------------------------------------------- */

typedef struct BvhioContainer BvhioContainer;

/* Flags of the open functions. */

/* Skips the checksums of payloads, and the checks of every vertex, triangle and node. Opening then takes time
 * for the pages that are touched, not for the whole file. Use it only for files that this machine has written
 * or has opened checked, and that nobody else can write: a damaged or hostile file makes a trusted open, or
 * later calls, crash or worse. Headers are still checked. */
#define BVHIO_TRUSTED 1u

/* [reader] Opens a file. A regular file is mapped: arrays that are stored with codec none are used in place,
 * and pages are read when they are touched. Do not cut or overwrite it in place while the container is open;
 * replacing it by a rename is safe. After a checked open (flags 0) all content is valid. Errors: BVHIO_IO;
 * BVHIO_INVALID and BVHIO_UNSUPPORTED, with a finding. `context` may be NULL; only its `threads` is used. */
BVHIO_API BvhioStatus bvhioOpenFile(const char* path, uint32_t flags, const BvhioContext* context,
                                    BvhioContainer** container);

/* [reader] Opens a container that is a part of a larger file: `length` bytes from `offset` on; length 0 means
 * up to the file's end. Any offset is allowed; at a multiple of 64 arrays are used in place, otherwise they are
 * copied. */
BVHIO_API BvhioStatus bvhioOpenFileRange(const char* path, uint64_t offset, uint64_t length, uint32_t flags,
                                         const BvhioContext* context, BvhioContainer** container);

/* [reader] Opens a container in memory, in place. Keep the bytes unchanged until the container, and everything
 * made from it (tracers, results of passes), is closed. At an address that is a multiple of 64, arrays that are
 * stored with codec none are not copied. */
BVHIO_API BvhioStatus bvhioOpenMemory(const void* bytes, size_t size, uint32_t flags,
                                      const BvhioContext* context, BvhioContainer** container);

/* [reader] Closes a container. NULL is allowed. */
BVHIO_API void bvhioClose(BvhioContainer* container);

/* [reader] Receives one finding about a file. `id` is its number, `isError` is 0 for a warning; `chunk` is
 * the four-letter type of the chunk, "" for the file; `offset` is the byte in the file and `node` the faulty
 * node, each UINT64_MAX if there is none. Texts are valid during the call. */
typedef void (*BvhioFindingCallback)(void* user, uint32_t id, int isError, const char* message,
                                     const char* chunk, uint64_t offset, uint64_t node);

/* [reader] Reports everything that is wrong with a file, with at most 8 findings of a kind; an open stops at the
 * first finding. BVHIO_OK means that the file could be examined, whatever was found. */
BVHIO_API BvhioStatus bvhioCheckFile(const char* path, const BvhioContext* context,
                                     BvhioFindingCallback found, void* user);
BVHIO_API BvhioStatus bvhioCheckMemory(const void* bytes, size_t size, const BvhioContext* context,
                                       BvhioFindingCallback found, void* user);

/* ---- What a container has -------------------------------------------------- */

/* Facts about a container. */
typedef struct BvhioInfo {
    uint64_t vertexCount;
    uint64_t triangleCount;  /* as stored, each mesh once */
    uint64_t geometryCount;  /* as stored */
    uint64_t meshCount;      /* 0 in a plain scene */
    uint64_t instanceCount;  /* 0 in a plain scene */
    uint64_t primitiveCount; /* what rays can hit: triangleCount, or the triangles of all instances */
    uint64_t treeCount;      /* trees that bvhioGetTree gives: 1; in an instanced scene 1 + meshCount */
    uint64_t nodeBytes;      /* of the nodes in memory, in the form they are stored in */
    uint64_t contentHash;    /* of the content, codecs left aside; 0 unless the container was opened */
    const char* form;        /* how nodes are stored, such as "aabb" or "quantized" */
    float traversalCost;     /* SAH costs that the tree was built for: of visiting an inner node, */
    float intersectionCost;  /* and of testing a ray against a triangle */
    uint32_t chunkCount;     /* chunks of the file; 0 unless the container was opened */
    uint32_t historyCount;   /* entries of its history */
} BvhioInfo;

/* [reader] Fills `info`. */
BVHIO_API BvhioStatus bvhioGetInfo(const BvhioContainer* container, BvhioInfo* info);

/* A chunk of the file that was opened. */
typedef struct BvhioChunk {
    char type[8];        /* four letters and a zero byte, such as "NODE" */
    uint32_t flags;      /* 1: critical; 2: survives a reorder of nodes; 4: survives a change of the tree */
    uint32_t reserved;   /* 0 */
    const char* codec;   /* such as "zstd"; "none" for payloads stored as they are */
    uint64_t rawSize;    /* of the payload when decoded */
    uint64_t storedSize; /* of the payload in the file */
    uint64_t offset;     /* of the chunk's header in the container; the payload is 64 bytes behind */
} BvhioChunk;

/* [reader] Fills `chunk` with chunk number `index`, below BvhioInfo::chunkCount, in file order. */
BVHIO_API BvhioStatus bvhioGetChunk(const BvhioContainer* container, uint64_t index, BvhioChunk* chunk);

/* A run of triangles that came from one part of the source. */
typedef struct BvhioGeometry {
    const char* name; /* may be "" */
    uint32_t firstTriangle, triangleCount;
} BvhioGeometry;

/* A run of geometries that instances place together. */
typedef struct BvhioMesh {
    uint32_t firstGeometry, geometryCount;
    uint32_t firstTriangle, triangleCount;
} BvhioMesh;

/* A placed mesh. */
typedef struct BvhioInstance {
    float objectToWorld[12]; /* the upper 3 x 4 of an affine matrix, row by row */
    uint32_t mesh;
    uint32_t firstPrimitive; /* the number that its first triangle has in hits */
    uint32_t firstGeometry;  /* the number that its first geometry has in hits */
} BvhioInstance;

/* An entry of the container's history: which program changed it, with which options. */
typedef struct BvhioHistory {
    const char* program; /* such as "bvh-build" */
    const char* version;
    const char* options; /* as JSON */
} BvhioHistory;

/* [reader] Fill the struct with element number `index`; an index at or above the count in BvhioInfo is
 * BVHIO_USAGE. */
BVHIO_API BvhioStatus bvhioGetGeometry(const BvhioContainer* container, uint64_t index,
                                       BvhioGeometry* geometry);
BVHIO_API BvhioStatus bvhioGetMesh(const BvhioContainer* container, uint64_t index, BvhioMesh* mesh);
BVHIO_API BvhioStatus bvhioGetInstance(const BvhioContainer* container, uint64_t index,
                                       BvhioInstance* instance);
BVHIO_API BvhioStatus bvhioGetHistory(const BvhioContainer* container, uint64_t index, BvhioHistory* history);

/* [reader] The vertices: 3 floats for each of `count`. All are finite, and none is -0. */
BVHIO_API BvhioStatus bvhioGetVertices(const BvhioContainer* container, const float** xyz, uint64_t* count);

/* [reader] The triangles: 3 vertex indices for each of `count`. All are in range. */
BVHIO_API BvhioStatus bvhioGetTriangles(const BvhioContainer* container, const uint32_t** indices,
                                        uint64_t* count);

/* [reader] The number of each triangle within its geometry in the source. NULL and 0 if triangles are numbered
 * in order. */
BVHIO_API BvhioStatus bvhioGetSourceIds(const BvhioContainer* container, const uint32_t** ids,
                                        uint64_t* count);

/* A node of a binary tree, 32 bytes. Two siblings lie beside each other, the left one at an even index. */
typedef struct BvhioNode {
    float min[3], max[3]; /* the box: finite, min <= max */
    uint32_t first; /* inner node: its left child, the right one is first + 1; leaf: its first primitive */
    uint32_t count; /* inner node: 0; leaf: its number of primitives */
} BvhioNode;

/* A tree. nodes[0] is the root and nodes[1] is unused. Children lie behind their parent, so a loop from the
 * last node to the first meets children before parents. The tree is at most BVHIO_MAX_DEPTH edges deep. */
typedef struct BvhioTree {
    const BvhioNode* nodes;
    uint64_t nodeCount; /* nodes[1] counts */
    const uint32_t* primitives;
    uint64_t primitiveCount;
} BvhioTree;

#define BVHIO_MAX_DEPTH 96

/* [reader] Tree number `index`, below BvhioInfo::treeCount. In a plain scene there is one, whose primitives
 * are triangles. In an instanced scene tree 0 is over the instances, one in each leaf, with boxes in the
 * world; tree 1 + m is over mesh m, in the mesh's own space, and its primitives count from the mesh's first
 * triangle. A triangle that was split is in several leaves. A compact form is decoded by the first call, with
 * boxes as the form has them, and kept until the container is closed. */
BVHIO_API BvhioStatus bvhioGetTree(const BvhioContainer* container, uint64_t index, BvhioTree* tree);

/* A primitive: a triangle, or a triangle of an instance. */
typedef struct BvhioPrimitive {
    uint32_t geometry;   /* numbered through all instances, as in hits */
    uint32_t sourceId;   /* the triangle's number within the geometry, in source order */
    uint32_t instance;   /* 0 in a plain scene */
    uint32_t triangle;   /* its index among the triangles */
    float corners[3][3]; /* in the world */
} BvhioPrimitive;

/* [reader] Fills `primitive` for the number that bvhioTraceClosest gave, below BvhioInfo::primitiveCount. */
BVHIO_API BvhioStatus bvhioGetPrimitive(const BvhioContainer* container, uint32_t number,
                                        BvhioPrimitive* primitive);

/* ---- Rays ------------------------------------------------------------------ */

/* The points origin + t * direction with tMin <= t <= tMax; 32 bytes, as in a .rays file. The direction need
 * not have length 1: t is in its units. A negative tMin counts as 0. A ray with a NaN, an infinite origin or
 * direction, a zero direction or tMax < tMin is allowed, and hits nothing. */
typedef struct BvhioRay {
    float origin[3];
    float tMin;
    float direction[3];
    float tMax; /* may be infinite */
} BvhioRay;

/* A hit, 24 bytes, as in a .hits file. u and v are the barycentric weights of the triangle's second and third
 * corner. The three ids do not depend on the scene's tree or form. A miss has t infinite, u = v = 0 and all ids
 * BVHIO_NOTHING. */
typedef struct BvhioHit {
    float t, u, v;
    uint32_t primitive; /* the triangle's number within the geometry, in source order */
    uint32_t geometry;
    uint32_t instance; /* 0 in a plain scene */
} BvhioHit;

#define BVHIO_NOTHING 0xFFFFFFFFu

typedef struct BvhioTracer BvhioTracer;

/* Flags of bvhioCreateTracer. */

/* Tests the scene's own triangles, through their indices: rays take about twice the time, but nothing is
 * copied. Without this flag the tracer makes a copy of the triangles for tracing, 48 bytes per triangle. */
#define BVHIO_NO_COPY 1u

/* [reader] Prepares a container for tracing. The tracer keeps the container's content alive. `context` may be
 * NULL; only its `threads` is used, for the copy. */
BVHIO_API BvhioStatus bvhioCreateTracer(const BvhioContainer* container, uint32_t flags,
                                        const BvhioContext* context, BvhioTracer** tracer);

/* [reader] Frees a tracer. NULL is allowed. */
BVHIO_API void bvhioDestroyTracer(BvhioTracer* tracer);

/* [reader] Finds the closest hit of each of `count` rays; of several hits at the same t, the lowest primitive
 * counts. `hits` has room for `count` elements. So has `primitives`, unless it is NULL: it receives the number
 * of the primitive that was hit (in a plain scene, the triangle's index), or BVHIO_NOTHING for a miss. At most
 * `threads` threads trace, including yours; 0: all. Hits are the same, to the bit, for every tree, form,
 * processor and number of threads. */
BVHIO_API BvhioStatus bvhioTraceClosest(const BvhioTracer* tracer, const BvhioRay* rays, size_t count,
                                        BvhioHit* hits, uint32_t* primitives, uint32_t threads);

/* [reader] Writes 1 for each ray that hits anything, otherwise 0. `occluded` has room for `count` bytes. */
BVHIO_API BvhioStatus bvhioTraceAny(const BvhioTracer* tracer, const BvhioRay* rays, size_t count,
                                    uint8_t* occluded, uint32_t threads);

/* [reader] The same for one ray, on the calling thread, without locks or allocations: for renderers that have
 * threads of their own. bvhioTraceRay returns 1 for a hit and 0 for a miss; hit and primitive may be NULL.
 * bvhioIsOccluded returns 1 if the ray hits anything, otherwise 0. Both do not check their pointers: tracer and
 * ray must be valid. */
BVHIO_API int bvhioTraceRay(const BvhioTracer* tracer, const BvhioRay* ray, BvhioHit* hit,
                            uint32_t* primitive);
BVHIO_API int bvhioIsOccluded(const BvhioTracer* tracer, const BvhioRay* ray);

/* ---- Scenes ---------------------------------------------------------------- */

typedef struct BvhioScene BvhioScene;

/* One part of a scene, for bvhioCreateScene. */
typedef struct BvhioPart {
    const char* name; /* NULL: "" */
    uint32_t triangleCount;
} BvhioPart;

/* A placed mesh, for bvhioCreateScene. */
typedef struct BvhioPlacement {
    uint32_t mesh;
    float objectToWorld[12]; /* as in BvhioInstance */
} BvhioPlacement;

/* A scene in your program's arrays. Set fields that you do not use to zero. */
typedef struct BvhioSceneArrays {
    const void* vertices;    /* each starts with three floats; any alignment */
    uint64_t vertexCount;    /* below 2^32 */
    uint64_t vertexStride;   /* bytes from one vertex to the next; 0: 12 */
    const uint32_t* indices; /* three for each triangle */
    uint64_t triangleCount;  /* 1 to 2^31 - 1 */

    const BvhioPart* parts; /* the geometries, one behind the other; NULL: one for all triangles */
    uint64_t partCount;
    const uint32_t* sourceIds; /* of each triangle within its geometry, for hits; NULL: 0, 1, 2, ... */

    const uint32_t* meshes; /* for instanced scenes: number of parts of each mesh; NULL: a plain scene */
    uint64_t meshCount;
    const BvhioPlacement* placements;
    uint64_t placementCount;
} BvhioSceneArrays;

/* Checks your arrays, and makes a scene of copies of them. BVHIO_INVALID, with the first fault in
 * bvhioLastError: no triangles, an index out of range, a NaN or infinite coordinate, counts that disagree, a
 * transform that cannot be inverted. BVHIO_UNSUPPORTED: a count above the limits at the fields above. Coordinates
 * of -0 become +0. */
BVHIO_API BvhioStatus bvhioCreateScene(const BvhioSceneArrays* arrays, BvhioScene** scene);

/* Frees a scene. NULL is allowed. */
BVHIO_API void bvhioDestroyScene(BvhioScene* scene);

/* ---- Passes ---------------------------------------------------------------- */

/* Kinds of methods that passes use; each method has a name. */
typedef enum BvhioMethod BVHIO_ANY_INT {
    BVHIO_BUILDER = 0,      /* of bvhioBuild: option "builder" */
    BVHIO_RESTRUCTURER = 1, /* of bvhioRestructure: option "method" */
    BVHIO_LAYOUT = 2,       /* of bvhioRelayout: option "layout" */
    BVHIO_FORM = 3,         /* of bvhioCompress: option "form" */
    BVHIO_CODEC = 4         /* of bvhioCompress: option "codec" */
} BvhioMethod;

/* The number of methods of a kind; a method's name; and a summary of it in one line. Method 0 is the default,
 * but for forms and codecs: see bvhioCompress.
 * The texts live as long as the program, and are NULL for an index beyond the last method. */
BVHIO_API uint64_t bvhioMethodCount(BvhioMethod kind);
BVHIO_API const char* bvhioMethodName(BvhioMethod kind, uint64_t index);
BVHIO_API const char* bvhioMethodSummary(BvhioMethod kind, uint64_t index);

/* Passes take options as texts "name=value", ended by NULL; NULL alone means defaults. Names, ranges and
 * defaults are those of the command-line tools (their pages are in tools/), without "--": { "builder=sweep",
 * "max-leaf-size=8", NULL }. An unknown name, a value out of range, or an option that the chosen method does
 * not use is BVHIO_USAGE, and bvhioLastError lists what is allowed. A pass does not change its input, and adds
 * an entry to the history of its result. With the same input and options a result is the same, to the byte, for
 * every number of threads. `context` may be NULL. */

/* Builds a tree. Options of bvh-build: builder, bins, max-leaf-size, split-budget, traversal-cost,
 * intersection-cost. An instanced scene gets a tree for each mesh, and one over the instances. */
BVHIO_API BvhioStatus bvhioBuild(const BvhioScene* scene, const char* const* options,
                                 const BvhioContext* context, BvhioContainer** result);

/* Lowers the SAH cost of a tree by changing its topology. Options of bvh-restructure: method,
 * iterations, treelet-size, gamma, collapse (yes or no), max-leaf-size. The result is in the aabb form;
 * of an instanced scene, in the two-level form with levels in the aabb form. */
BVHIO_API BvhioStatus bvhioRestructure(const BvhioContainer* container, const char* const* options,
                                       const BvhioContext* context, BvhioContainer** result);

/* Orders the nodes in memory. Options of bvh-relayout: layout, probability, smoothing, line-size,
 * record-bytes, threshold, treelet-size, pointer-bits. The result is in the aabb form, as
 * that of bvhioRestructure. */
BVHIO_API BvhioStatus bvhioRelayout(const BvhioContainer* container, const char* const* options,
                                    const BvhioContext* context, BvhioContainer** result);

/* Stores the tree in another form, and chooses how a save of the result stores the chunks. Options of
 * bvh-compress: form and the options of the forms; codec, level, geometry, position-bits, triangle-order,
 * vertex-order. Default form: a compact form stays as it is; otherwise quantized, and two-level for an instanced
 * scene. Default codec: zstd; "topology" is allowed, too. With geometry=draco the vertices move when the result
 * is saved, not before. */
BVHIO_API BvhioStatus bvhioCompress(const BvhioContainer* container, const char* const* options,
                                    const BvhioContext* context, BvhioContainer** result);

/* Writes the SAH cost of the tree, as its form stores it, to `cost`. */
BVHIO_API BvhioStatus bvhioGetCost(const BvhioContainer* container, double* cost);

/* ---- Saving ---------------------------------------------------------------- */

/* Saves a container as a .bvhx file: with the codec and geometry that bvhioCompress chose, otherwise with codec
 * none and unchanged geometry. A temporary file is written beside `path`, flushed to the disk and renamed. So
 * there is always the old file or the whole new file, even if the power fails, and a container that was opened
 * from `path` stays usable. Errors: BVHIO_IO. `context` may be NULL; only its `threads` is used. */
BVHIO_API BvhioStatus bvhioSaveFile(const BvhioContainer* container, const char* path,
                                    const BvhioContext* context);

/* Saves to memory. `bytes` receives a block of `size` bytes at an address that is a multiple of 64, suitable for
 * bvhioOpenMemory. Free it with bvhioFree. `context` is as for bvhioSaveFile. */
BVHIO_API BvhioStatus bvhioSaveMemory(const BvhioContainer* container, const BvhioContext* context,
                                      void** bytes, size_t* size);

/* Frees a block that bvhioSaveMemory gave. NULL is allowed. */
BVHIO_API void bvhioFree(void* bytes);

#ifdef __cplusplus
}
#endif

#endif
