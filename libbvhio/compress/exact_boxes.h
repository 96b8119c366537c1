// The tree that a form's larger boxes stand for.
#pragma once

#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

/// The same tree with the smallest boxes that hold the triangles below each node: what a builder made, before
/// a form enlarged its boxes. Parallel.
///
/// Which part of a triangle a spatial split gave to which leaf is not stored: for such trees a leaf's box is
/// that around what of its triangles lies within the box it has. A part that the split gave to the leaf lies
/// there, with the margin that core/clip_triangle.h proves to be enough: the hits stay the same. Leaves that
/// nothing of their triangles reaches into keep their boxes.
Bvh withExactBoxes(const Scene& scene, const Bvh& bvh);

}  // namespace bvhio
