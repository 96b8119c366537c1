// The header of a PLY file: which elements with which properties the body has, and in which format.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bvhio {

enum class PlyFormat { ascii, littleEndian, bigEndian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr size_t byteSize(PlyType type) {
    constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[size_t(type)];
}

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> listCount;  // the type of a list's length; absent for a single value
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Bytes of one element in binary; the fewest possible where it has lists.
    size_t minBytes() const;
    bool hasList() const;
    /// The index of a property, or -1.
    int find(const std::string& property) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    size_t size = 0;  // the body begins here
};

/// Reads the header of a whole file. Throws Error invalid for a damaged header, and for a header that claims
/// more elements than the bytes after it can hold.
PlyHeader readPlyHeader(std::span<const std::byte> bytes, const std::string& name);

}  // namespace bvhio
