// Other ways to store the nodes of the aabb form in memory, for comparisons. The hits are the same.
//
// T. Aila and S. Laine, "Understanding the Efficiency of Ray Traversal on GPUs" (HPG 2009), step through
// records of 64 bytes with the boxes of both children and a reference to each. S. Wodniok, A. Schulz, S.
// Widmer and M. Goesele, "Analysis of Cache Behavior and Performance of Different BVH Memory Layouts for
// Tracing Incoherent Rays" (EGPGV 2013), compare these with the same 56 bytes in several arrays: three of 16
// bytes and one of 8, or one of 32 and one of 24. The division of fields into arrays is our choice. Records
// are in the order of the sibling pairs. The root's box is stored separately.
//
// A reference has 32 bits. It is the number of a record, or, with the highest bit set, a leaf: its number of
// triangles minus 1 above its first entry in the primitive array, with as many bits for each as the tree
// needs. Boxes are tested plane by plane, so that references are never in lanes next to planes, where as
// floats they would be denormal and slow.
#pragma once

#include <variant>

#include "compress/aabb_form.h"
#include "core/choice.h"

namespace bvhio {

/// The encoding of references.
class ChildReferences {
  public:
    explicit ChildReferences(const Bvh& bvh);

    uint32_t of(const Node& node) const {
        return node.isLeaf() ? kLeaf | (node.primitiveCount - 1) << firstBits_ | node.first
                             : node.first / 2 - 1;  // the pair in slots 2 and 3 is record 0
    }
    static BVHIO_INLINE bool isLeaf(uint32_t reference) { return (reference & kLeaf) != 0; }
    BVHIO_INLINE PrimitiveRange range(uint32_t reference) const {
        return {reference & ((1u << firstBits_) - 1), ((reference & ~kLeaf) >> firstBits_) + 1};
    }

  private:
    static constexpr uint32_t kLeaf = 0x80000000;
    uint32_t firstBits_;
};

/// Returns the place of an array after another one, for metrics. Each array starts at a cache line.
constexpr size_t behindArray(size_t offset, size_t bytes) {
    return (offset + bytes + 63) / 64 * 64;
}

/// An array of records of 64 bytes with both boxes and both references.
class RecordArray {
  public:
    struct alignas(64) Record {
        float boxes[2][6];  // min.xyz, max.xyz
        uint32_t children[2];
        uint32_t unused[2];
    };
    static_assert(sizeof(Record) == 64);

    explicit RecordArray(size_t count) : records_(count) {}
    void set(size_t i, const Node& left, const Node& right, const ChildReferences& references);
    size_t bytes() const { return behindArray(0, records_.size() * sizeof(Record)); }

    using Ray = const PreparedRay&;
    static const PreparedRay& prepare(const PreparedRay& ray) { return ray; }
    template <class Metrics>
    BVHIO_INLINE void recordFetches(size_t i, Metrics& metrics) const {
        metrics.recordFetched(i * sizeof(Record), sizeof(Record));
    }
    BVHIO_INLINE RayInterval clip(size_t i, int which, const PreparedRay& ray, float tLimit) const {
        return clipToPlanes(ray, records_[i].boxes[which], tLimit);
    }
    BVHIO_INLINE uint32_t child(size_t i, int which) const { return records_[i].children[which]; }

  private:
    AlignedVector<Record> records_;
};

/// An array of 32 bytes with the left box and both references, and an array of 24 bytes with the right box.
class ArraysOf32And24 {
  public:
    struct Left {
        float planes[6];
        uint32_t children[2];
    };
    struct Right {
        float planes[6];
    };
    static_assert(sizeof(Left) == 32 && sizeof(Right) == 24);

    explicit ArraysOf32And24(size_t count)
        : left_(count), right_(count), rightAt_(behindArray(0, count * 32)) {}
    void set(size_t i, const Node& left, const Node& right, const ChildReferences& references);
    size_t bytes() const { return behindArray(rightAt_, right_.size() * sizeof(Right)); }

    using Ray = const PreparedRay&;
    static const PreparedRay& prepare(const PreparedRay& ray) { return ray; }
    template <class Metrics>
    BVHIO_INLINE void recordFetches(size_t i, Metrics& metrics) const {
        metrics.recordFetched(i * sizeof(Left), sizeof(Left));
        metrics.recordFetched(rightAt_ + i * sizeof(Right), sizeof(Right));
    }
    BVHIO_INLINE RayInterval clip(size_t i, int which, const PreparedRay& ray, float tLimit) const {
        return clipToPlanes(ray, which == 0 ? left_[i].planes : right_[i].planes, tLimit);
    }
    BVHIO_INLINE uint32_t child(size_t i, int which) const { return left_[i].children[which]; }

  private:
    AlignedVector<Left> left_;
    AlignedVector<Right> right_;
    size_t rightAt_;
};

/// Three arrays of 16 bytes (x and y of the left box, x and y of the right box, z of both), and one of 8:
/// references.
class ArraysOf16And8 {
  public:
    /// Throws Error{unsupported} for more than 2^28 records, since planes have 32-bit numbers.
    explicit ArraysOf16And8(size_t count);
    void set(size_t i, const Node& left, const Node& right, const ChildReferences& references);
    size_t bytes() const { return behindArray(childrenAt(), children_.size() * sizeof(Children)); }

    /// The ray, and the same ray for each of the two boxes: its near and far planes are given by their
    /// distance in floats from the first plane of the box.
    struct Ray {
        const PreparedRay& given;
        PreparedRay toLeft, toRight;
    };
    Ray prepare(const PreparedRay& ray) const {
        return {ray, withPlanes(ray, 2 * arrayFloats_), withPlanes(ray, arrayFloats_ + 2)};
    }
    template <class Metrics>
    BVHIO_INLINE void recordFetches(size_t i, Metrics& metrics) const {
        for (size_t array = 0; array < 3; ++array)
            metrics.recordFetched((array * arrayFloats_ + 4 * i) * sizeof(float), 4 * sizeof(float));
        metrics.recordFetched(childrenAt() + i * sizeof(Children), sizeof(Children));
    }
    BVHIO_INLINE RayInterval clip(size_t i, int which, const Ray& ray, float tLimit) const {
        const float* box = planes_.data() + (which == 0 ? 0 : arrayFloats_) + 4 * i;
        return clipToPlanes(which == 0 ? ray.toLeft : ray.toRight, box, tLimit);
    }
    BVHIO_INLINE uint32_t child(size_t i, int which) const { return children_[i].references[which]; }

  private:
    struct alignas(8) Children {
        uint32_t references[2];
    };

    size_t childrenAt() const { return 3 * arrayFloats_ * sizeof(float); }
    /// min.x and max.x are the first floats of a box, min.y and max.y the next, and min.z and max.z start at
    /// zAt.
    static PreparedRay withPlanes(PreparedRay ray, size_t zAt) {
        const uint32_t min[] = {0, 2, uint32_t(zAt)};
        for (uint32_t axis = 0; axis < 3; ++axis) {
            ray.nearPlane[axis] = min[axis] + ray.nearPlane[axis] / 3;
            ray.farPlane[axis] = min[axis] + ray.farPlane[axis] / 3;
        }
        return ray;
    }

    size_t arrayFloats_;  // from one array to the next
    AlignedVector<float> planes_;
    AlignedVector<Children> children_;
};

/// Nodes stored in `Arrays`.
template <class Arrays>
class NodesIn {
  public:
    /// Throws Error{unsupported} if leaves are too large and too many for references.
    explicit NodesIn(const AabbForm& form);

    std::span<const uint32_t> primitives() const { return primitives_; }
    size_t nodeBytes() const { return arrays_.bytes(); }
    const Aabb& bounds() const { return bounds_; }
    const ChildReferences& references() const { return references_; }
    uint32_t root() const { return root_; }
    const Arrays& arrays() const { return arrays_; }

  private:
    Aabb bounds_;
    ChildReferences references_;
    uint32_t root_;
    Arrays arrays_;
    SharedArray<uint32_t> primitives_;
};

/// The form's own 32-byte nodes in sibling pairs, as one of the kinds of storage.
struct NodesInPairs : AabbForm {
    using AabbForm::AabbForm;
};

using StoredNodes =
    std::variant<NodesInPairs, NodesIn<RecordArray>, NodesIn<ArraysOf16And8>, NodesIn<ArraysOf32And24>>;

using NodeStorage = Choice<StoredNodes (*)(const AabbForm&)>;

/// Returns all kinds of storage; that of the form itself is the first.
std::span<const NodeStorage> nodeStorages();

}  // namespace bvhio
