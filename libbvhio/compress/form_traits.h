// What forms do to a tree. Code that depends on it asks for a trait, not for the name of a form. So a new
// form has all answers in its own file.
#pragma once

namespace bvhio {

/// What happens to a valid tree that a form encodes and decodes.
struct FormTraits {
    /// Every box is unchanged, bit by bit. So a file can leave boxes out, and a reader can fit them again.
    bool isExact = false;
    /// The primitive array is unchanged.
    bool keepsOrder = false;
    /// Large leaves may be divided.
    bool dividesLeaves = false;
    /// Leaves may be joined, and their triangles divided in another way. Parts of a split triangle are then
    /// cut from the boxes of the given leaves.
    bool mergesLeaves = false;
    /// The form builds its own tree from the scene's triangles, and uses nothing of the given tree.
    bool buildsOwnTree = false;
    /// Pairs are in clusters (tree/bvh.h: SlotMap): the given tree's if it has any, otherwise new ones.
    bool putsInClusters = false;
    /// The form can also hold a tree over the instances of a scene and the trees of its meshes. Then it has
    /// encodeInstances and decodeInstances.
    bool holdsInstances = false;
};

}  // namespace bvhio
