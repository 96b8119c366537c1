// Restores exact boxes from the larger boxes of a form.
#pragma once

#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

/// Returns the same tree with the smallest boxes that contain the triangles below each node, which are the
/// builder's boxes, before a form enlarged them. Parallel.
///
/// Files do not store which part of a triangle a spatial split gave to which leaf. In such trees, the new box
/// of a leaf is the box around the parts of its triangles inside its old box. The part that the split gave to
/// the leaf lies there, with a margin that core/clip_triangle.h proves to be enough, so hits stay the same. A
/// leaf whose triangles do not reach into its box keeps the box.
Bvh withExactBoxes(const Scene& scene, const Bvh& bvh);

}  // namespace bvhio
