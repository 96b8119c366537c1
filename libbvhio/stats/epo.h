// End-point overlap: how much of the scene's surface lies in boxes of nodes to which it does not belong.
#pragma once

#include "scene/scene.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

struct EpoOptions {
    uint64_t exactUpTo = 2'000'000;  // triangles; scenes with more triangles are sampled
    uint32_t samples = 1u << 18;     // draws if sampled; rounded up to an even number
    uint64_t seed = 1;
};

struct Epo {
    double value = 0;
    double standardError = 0;       // of a sampled value; 0 if exact
    uint64_t sampledTriangles = 0;  // distinct triangles that were clipped; all of the scene's if exact
    bool isExact = true;
};

/// Returns the EPO of a tree: the sum over nodes n of C_n * area(surface inside n's box of triangles without
/// a reference below n) / area(all surface). C_n is the traversal cost of an inner node, or the intersection
/// cost of a leaf times its number of references. Boxes are closed: a triangle in the plane of a flat box, or
/// of a face of a box, is inside. The EPO of a scene without area is 0. The value does not depend on the
/// number of threads or the processor, and depends on the layout only by rounding.
Epo epo(const Scene& scene, const Bvh& bvh, const SahCosts& costs, const EpoOptions& options = {});

}  // namespace bvhio
