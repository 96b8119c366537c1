// End-point overlap: how much of the scene's surface lies in boxes that it was not put into.
#pragma once

#include "scene/scene.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

struct EpoOptions {
    uint64_t exactUpTo = 2'000'000;  // triangles; scenes with more are sampled
    uint32_t samples = 1u << 18;     // draws when sampled; rounded up to an even number
    uint64_t seed = 1;
};

struct Epo {
    double value = 0;
    double standardError = 0;       // of a sampled value; 0 when exact
    uint64_t sampledTriangles = 0;  // distinct triangles that were clipped: all of the scene's when exact
    bool isExact = true;
};

/// The EPO of a tree: the sum over nodes n of C_n * area(surface within n's box of triangles without a
/// reference below n) / area (all surface), where C_n is the traversal cost of an inner node and the
/// intersection cost times the references of a leaf. Boxes are closed: a triangle in the plane of a flat box
/// or of a box's face is within. 0 for a scene without area. The value depends on neither the number of
/// threads nor the processor, and on the layout only by rounding.
Epo epo(const Scene& scene, const Bvh& bvh, const SahCosts& costs, const EpoOptions& options = {});

}  // namespace bvhio
