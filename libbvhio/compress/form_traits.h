// What forms do to a tree. Whoever needs to know asks for a trait, not for a form's name, so that a new form
// has its answers in its own file.
#pragma once

namespace bvhio {

/// Of the tree that comes back when a form's encoding of a valid tree is decoded.
struct FormTraits {
    /// Every box is the one that was encoded, bit by bit. So a file can leave them out and fit them again.
    bool isExact = false;
    /// The primitive array is the one that was encoded.
    bool keepsOrder = false;
    /// Large leaves may have become several.
    bool dividesLeaves = false;
    /// Leaves may have been joined, and their triangles divided anew: where a triangle was split, its parts
    /// are cut from the boxes of those leaves.
    bool mergesLeaves = false;
    /// The form makes a tree from the scene's triangles and takes nothing from the one that is given.
    bool buildsOwnTree = false;
    /// Pairs are in clusters (tree/bvh.h: SlotMap): the tree's own where it has some, else new ones.
    bool putsInClusters = false;
    /// The form also holds a tree over the instances of a scene and the trees of its meshes: it has
    /// encodeInstances and decodeInstances.
    bool holdsInstances = false;
};

}  // namespace bvhio
