#include "importers/gltf_accessors.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/plural.h"

namespace bvhio {

namespace {

template <class T>
T load(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

size_t componentBytes(int componentType) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

float loadNumber(const std::byte* at, int componentType) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return load<int8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return load<int16_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<uint16_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return float(load<uint32_t>(at));
        default:
            return load<float>(at);
    }
}

uint32_t loadIndex(const std::byte* at, int componentType) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<uint16_t>(at);
        default:
            return load<uint32_t>(at);
    }
}

bool isIndexType(int componentType) {
    return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

int componentsOf(int type) {
    return type == TINYGLTF_TYPE_SCALAR ? 1
           : type == TINYGLTF_TYPE_VEC2 ? 2
           : type == TINYGLTF_TYPE_VEC3 ? 3
           : type == TINYGLTF_TYPE_VEC4 ? 4
                                        : 0;
}

}  // namespace

/// Where an accessor's elements lie; `data` is empty for zeros.
struct GltfAccessors::Elements {
    std::span<const std::byte> data;
    size_t stride, count;
    int componentType, components;
    float divisor;  // 0 for numbers that are not normalised

    void load(const std::byte* at, float* numbers) const {
        for (int c = 0; c < components; ++c) {
            const float number = loadNumber(at + size_t(c) * componentBytes(componentType), componentType);
            // The most negative integer means -1 too.
            numbers[c] = divisor == 0 ? number : std::max(number / divisor, -1.0f);
        }
    }
    void load(size_t i, float* numbers) const {
        if (data.empty())
            std::fill(numbers, numbers + components, 0.0f);
        else
            load(data.data() + i * stride, numbers);
    }
};

std::string GltfAccessors::where(int accessor) const {
    return document_.name + ": accessor " + std::to_string(accessor);
}

const tinygltf::Accessor& GltfAccessors::find(int accessor) const {
    if (accessor < 0 || size_t(accessor) >= document_.model.accessors.size())
        throw Error(ErrorKind::invalid, where(accessor) + ": the file has no such accessor");
    return document_.model.accessors[size_t(accessor)];
}

float GltfAccessors::normalisation(int accessor) const {
    const tinygltf::Accessor& source = find(accessor);
    if (!source.normalized) return 0;
    switch (source.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return 127;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 255;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return 32767;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 65535;
        default:
            return 0;
    }
}

GltfAccessors::Elements GltfAccessors::elements(int accessor, int components) {
    const tinygltf::Accessor& source = find(accessor);
    const size_t size = componentBytes(source.componentType) * size_t(components);
    if (componentsOf(source.type) != components || size == 0)
        throw Error(ErrorKind::invalid, where(accessor) + ": its type is not allowed for this attribute");
    Elements result{{}, size, source.count, source.componentType, components, normalisation(accessor)};
    if (source.bufferView >= 0) {
        result.data = buffers_.view(source.bufferView);
        const size_t stride = document_.model.bufferViews[size_t(source.bufferView)].byteStride;
        if (stride != 0) result.stride = stride;
        const size_t available = result.data.size();
        const bool fits = result.count == 0 ||
                          (source.byteOffset <= available && size <= available - source.byteOffset &&
                           (result.count - 1) <= (available - source.byteOffset - size) / result.stride);
        if (!fits)
            throw Error(ErrorKind::invalid, where(accessor) + ": buffer view " +
                                                std::to_string(source.bufferView) + " is too small for its " +
                                                counted(result.count, "element"));
        if (result.count > 0) result.data = result.data.subspan(source.byteOffset);
    }
    return result;
}

template <class Store>
void GltfAccessors::overlaySparse(int accessor, const Elements& layout, const Store& store) {
    const tinygltf::Accessor& source = find(accessor);
    if (!source.sparse.isSparse) return;
    const auto& sparse = source.sparse;
    const auto fail = [&](const char* what) {
        throw Error(ErrorKind::invalid, where(accessor) + ": " + what);
    };
    if (!isIndexType(sparse.indices.componentType))
        fail("its sparse indices have a type that is not allowed");
    const size_t size = componentBytes(layout.componentType) * size_t(layout.components);
    const size_t indexSize = componentBytes(sparse.indices.componentType);
    const auto indices = buffers_.view(sparse.indices.bufferView),
               values = buffers_.view(sparse.values.bufferView);
    const auto count = size_t(sparse.count), indexOffset = size_t(sparse.indices.byteOffset),
               valueOffset = size_t(sparse.values.byteOffset);
    if (indexOffset > indices.size() || count > (indices.size() - indexOffset) / indexSize ||
        valueOffset > values.size() || count > (values.size() - valueOffset) / size)
        fail("its sparse elements reach beyond their buffer views");
    for (size_t i = 0; i < count; ++i) {
        const uint32_t element =
            loadIndex(indices.data() + indexOffset + i * indexSize, sparse.indices.componentType);
        if (element >= layout.count) fail("a sparse index is out of range");
        store(element, values.data() + valueOffset + i * size);
    }
}

std::vector<float> GltfAccessors::readNumbers(int accessor, int components) {
    const Elements layout = elements(accessor, components);
    buffers_.spend(uint64_t(layout.count) * size_t(components) * sizeof(float));
    std::vector<float> numbers(layout.count * size_t(components));
    for (size_t i = 0; i < layout.count; ++i) layout.load(i, &numbers[i * size_t(components)]);
    overlaySparse(accessor, layout, [&](uint32_t element, const std::byte* value) {
        layout.load(value, &numbers[element * size_t(components)]);
    });
    return numbers;
}

std::vector<Vec3> GltfAccessors::readVectors(int accessor) {
    const Elements layout = elements(accessor, 3);
    buffers_.spend(uint64_t(layout.count) * sizeof(Vec3));
    std::vector<Vec3> vectors(layout.count);
    for (size_t i = 0; i < layout.count; ++i) layout.load(i, &vectors[i].x);
    overlaySparse(accessor, layout,
                  [&](uint32_t element, const std::byte* value) { layout.load(value, &vectors[element].x); });
    return vectors;
}

std::vector<Vec3> GltfAccessors::readVectors(int accessor, std::span<const uint32_t> wanted) {
    buffers_.spend(wanted.size() * sizeof(Vec3));
    std::vector<Vec3> vectors(wanted.size());
    if (find(accessor).sparse.isSparse) {
        const std::vector<Vec3> all = readVectors(accessor);
        for (size_t i = 0; i < wanted.size(); ++i) vectors[i] = all[wanted[i]];
        return vectors;
    }
    const Elements layout = elements(accessor, 3);
    for (size_t i = 0; i < wanted.size(); ++i) layout.load(wanted[i], &vectors[i].x);
    return vectors;
}

std::vector<uint32_t> GltfAccessors::readIndices(int accessor) {
    if (!isIndexType(find(accessor).componentType))
        throw Error(ErrorKind::invalid, where(accessor) + ": indices must be unsigned integers");
    const Elements layout = elements(accessor, 1);
    buffers_.spend(uint64_t(layout.count) * sizeof(uint32_t));
    std::vector<uint32_t> indices(layout.count);
    if (!layout.data.empty())
        for (size_t i = 0; i < layout.count; ++i)
            indices[i] = loadIndex(layout.data.data() + i * layout.stride, layout.componentType);
    overlaySparse(accessor, layout, [&](uint32_t element, const std::byte* value) {
        indices[element] = loadIndex(value, layout.componentType);
    });
    return indices;
}

}  // namespace bvhio
