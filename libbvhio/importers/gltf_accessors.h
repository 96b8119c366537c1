// Typed reading of a glTF file's accessors.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "importers/gltf_buffers.h"

namespace bvhio {

/// Reads accessors of any component type, interleaved, sparse, or without a buffer view (all zeros). Throws
/// Error invalid, naming the accessor, when one does not exist, has the wrong type, or reaches beyond its
/// buffer view.
class GltfAccessors {
  public:
    GltfAccessors(const GltfDocument& document, GltfBuffers& buffers)
        : document_(document), buffers_(buffers) {}

    size_t count(int accessor) const { return find(accessor).count; }
    /// Elements of `components` numbers each, one after the other; integers divided by their maximum where
    /// the accessor is normalised.
    std::vector<float> readNumbers(int accessor, int components);
    /// Three-component elements: all of them, or those with the given ascending numbers, each less than the
    /// count.
    std::vector<Vec3> readVectors(int accessor);
    std::vector<Vec3> readVectors(int accessor, std::span<const uint32_t> elements);
    /// Scalars of an unsigned integer type.
    std::vector<uint32_t> readIndices(int accessor);
    /// The divisor of the accessor's normalised integers, or 0 for an accessor that is not normalised.
    float normalisation(int accessor) const;

  private:
    struct Elements;
    const tinygltf::Accessor& find(int accessor) const;
    Elements elements(int accessor, int components);
    template <class Store>
    void overlaySparse(int accessor, const Elements& layout, const Store& store);
    std::string where(int accessor) const;

    const GltfDocument& document_;
    GltfBuffers& buffers_;
};

}  // namespace bvhio
