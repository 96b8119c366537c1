#include "importers/gltf_import.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/error.h"
#include "importers/gltf_primitive.h"

namespace bvhio {

namespace {

constexpr uint64_t kFreeInstances = 1 << 20;

std::string numbered(const char* word, size_t number) {
    std::string text = word;
    return text += std::to_string(number);
}

/// The transform that applies `b` first, then `a`.
Transform multiply(const Transform& a, const Transform& b) {
    Transform product;
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 4; ++column) {
            double sum = column == 3 ? a[4 * row + 3] : 0;
            for (size_t k = 0; k < 3; ++k) sum += a[4 * row + k] * b[4 * k + column];
            product[4 * row + column] = sum;
        }
    return product;
}

/// Scale, then rotation by the unit quaternion (x, y, z, w), then translation.
template <class Number>
Transform compose(const Number* translation, const Number* rotation, const Number* scale) {
    const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                         2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                         2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    Transform result;
    for (size_t row = 0; row < 3; ++row) {
        for (size_t column = 0; column < 3; ++column)
            result[4 * row + column] = r[3 * row + column] * scale[column];
        result[4 * row + 3] = translation[row];
    }
    return result;
}

class SceneReader {
  public:
    SceneReader(const GltfDocument& document, const std::filesystem::path& directory, size_t fileBytes)
        : document_(document),
          buffers_(document, directory, fileBytes),
          accessors_(document, buffers_),
          maxInstances_(kFreeInstances + fileBytes) {}

    ImportedScene read() {
        // Depth first, children in order: the next node is on top.
        std::vector<Visit> stack;
        for (const int root : reversed(roots())) stack.push_back({root, kIdentityTransform});
        std::vector<bool> visited(document_.model.nodes.size(), false);
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            if (size_t(visit.node) >= visited.size())
                fail("the file has no node " + std::to_string(visit.node));
            if (visited[size_t(visit.node)])
                fail("node " + std::to_string(visit.node) + " has two parents, or is its own ancestor");
            visited[size_t(visit.node)] = true;
            const tinygltf::Node& node = document_.model.nodes[size_t(visit.node)];
            const Transform world = multiply(visit.parent, localTransform(node, visit.node));
            if (node.mesh >= 0) addNode(node, visit.node, world);
            scene_.leftOut.skins += node.mesh >= 0 && node.skin >= 0;
            scene_.leftOut.cameras += node.camera >= 0;
            for (const int child : reversed(node.children)) stack.push_back({child, world});
        }
        scene_.leftOut.unusedMeshes = document_.model.meshes.size() - parts_.size();
        return std::move(scene_);
    }

  private:
    struct Visit {
        int node;
        Transform parent;
    };

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorKind::invalid, document_.name + ": " + what);
    }

    static std::vector<int> reversed(const std::vector<int>& list) { return {list.rbegin(), list.rend()}; }

    std::vector<int> roots() const {
        const tinygltf::Model& model = document_.model;
        if (!model.scenes.empty()) {
            const int scene = std::max(model.defaultScene, 0);
            if (size_t(scene) >= model.scenes.size())
                fail("the default scene, " + std::to_string(scene) + ", does not exist");
            return model.scenes[size_t(scene)].nodes;
        }
        // The file has nodes but no scene: all of them are read, each tree from its root.
        std::vector<bool> isChild(model.nodes.size(), false);
        for (const tinygltf::Node& node : model.nodes)
            for (const int child : node.children)
                if (size_t(child) < isChild.size()) isChild[size_t(child)] = true;
        std::vector<int> roots;
        for (size_t i = 0; i < isChild.size(); ++i)
            if (!isChild[i]) roots.push_back(int(i));
        if (roots.empty() && !model.nodes.empty())
            fail("every node is the child of another: the nodes form a cycle");
        return roots;
    }

    Transform localTransform(const tinygltf::Node& node, int number) const {
        const std::string where = "node " + std::to_string(number) + ": ";
        if (!node.matrix.empty()) {
            if (node.matrix.size() != 16) fail(where + "its matrix does not have 16 numbers");
            Transform result;
            for (size_t row = 0; row < 3; ++row)  // glTF stores columns
                for (size_t column = 0; column < 4; ++column)
                    result[4 * row + column] = node.matrix[4 * column + row];
            return result;
        }
        const auto part = [&](const std::vector<double>& given, std::vector<double> standard,
                              const char* what) {
            if (!given.empty() && given.size() != standard.size())
                fail(where + "its " + what + " has the wrong length");
            return given.empty() ? standard : given;
        };
        return compose(part(node.translation, {0, 0, 0}, "translation").data(),
                       part(node.rotation, {0, 0, 0, 1}, "rotation").data(),
                       part(node.scale, {1, 1, 1}, "scale").data());
    }

    /// The places of a node's mesh: its own, or those of EXT_mesh_gpu_instancing.
    std::vector<Transform> placements(const tinygltf::Node& node, int number, const Transform& world) {
        const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
        if (extension == node.extensions.end()) return {world};
        const std::string where = "node " + std::to_string(number) + ": EXT_mesh_gpu_instancing ";
        const tinygltf::Value& attributes = extension->second.Get("attributes");
        if (!attributes.IsObject() || attributes.Size() == 0) fail(where + "has no attributes");
        const auto countOf = [&](const std::string& key) {
            const tinygltf::Value& accessor = attributes.Get(key);
            if (!accessor.IsInt()) fail(where + "has a " + key + " that is not an accessor");
            return accessors_.count(accessor.Get<int>());
        };
        std::optional<size_t> common;
        for (const char* key : {"TRANSLATION", "ROTATION", "SCALE"}) {
            if (!attributes.Has(key)) continue;
            const size_t elements = countOf(key);
            if (common && elements != *common) fail(where + "has attributes of different lengths");
            common = elements;
        }
        // Without those, an attribute of the application's own has the number of instances.
        if (!common) common = countOf(attributes.Keys().front());
        const size_t count = *common;
        const auto read = [&](const char* key, int components) -> std::vector<float> {
            if (!attributes.Has(key)) return {};
            return accessors_.readNumbers(attributes.Get(key).Get<int>(), components);
        };
        const std::vector<float> translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4),
                                 scales = read("SCALE", 3);
        buffers_.spend(count * sizeof(Transform) / 4);
        const float zero[3] = {0, 0, 0}, one[3] = {1, 1, 1}, unturned[4] = {0, 0, 0, 1};
        std::vector<Transform> places;
        places.reserve(count);
        for (size_t i = 0; i < count; ++i)
            places.push_back(multiply(world, compose(translations.empty() ? zero : &translations[3 * i],
                                                     rotations.empty() ? unturned : &rotations[4 * i],
                                                     scales.empty() ? one : &scales[3 * i])));
        return places;
    }

    /// A primitive of a glTF mesh: its imported mesh, and its own name.
    struct Part {
        uint32_t mesh;
        std::string name;
    };

    /// The parts of a glTF mesh. They are read when the first node uses the mesh.
    const std::vector<Part>& partsOf(int mesh, int node) {
        const auto [known, isNew] = parts_.try_emplace(mesh);
        if (!isNew) return known->second;
        if (size_t(mesh) >= document_.model.meshes.size())
            fail("node " + std::to_string(node) + ": the file has no mesh " + std::to_string(mesh));
        const tinygltf::Mesh& source = document_.model.meshes[size_t(mesh)];
        for (size_t i = 0; i < source.primitives.size(); ++i) {
            std::string name = source.name.empty() ? numbered("mesh", size_t(mesh)) : source.name;
            if (source.primitives.size() > 1) name += numbered(".", i);
            const std::string where = document_.name + ": mesh " + std::to_string(mesh) + " '" + source.name +
                                      "', primitive " + std::to_string(i);
            known->second.push_back({importPrimitive(source.primitives[i], name, where), name});
        }
        countLeftOut(source);
        return known->second;
    }

    void countLeftOut(const tinygltf::Mesh& mesh) {
        uint64_t targets = 0;  // all primitives of a mesh have the same
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            const bool hasPositions = primitive.attributes.contains("POSITION");
            scene_.leftOut.withoutPositions += !hasPositions;
            scene_.leftOut.points += hasPositions && primitive.mode == TINYGLTF_MODE_POINTS;
            scene_.leftOut.lines += hasPositions && primitive.mode > TINYGLTF_MODE_POINTS &&
                                    primitive.mode < TINYGLTF_MODE_TRIANGLES;
            targets = std::max(targets, uint64_t(std::max(attributeOf(primitive, kTargetsKey), 0)));
        }
        scene_.leftOut.morphTargets += targets;
    }

    /// The number kept as an attribute of a primitive, or -1.
    static int attributeOf(const tinygltf::Primitive& primitive, const char* key) {
        const auto it = primitive.attributes.find(key);
        return it == primitive.attributes.end() ? -1 : it->second;
    }

    /// Imports a primitive, or finds the one with the same data: files often have meshes that differ only in
    /// their material.
    uint32_t importPrimitive(const tinygltf::Primitive& primitive, const std::string& name,
                             const std::string& where) {
        const auto draco = primitive.extensions.find("KHR_draco_mesh_compression");
        int dracoView = -1;
        if (draco != primitive.extensions.end() && draco->second.Get("bufferView").IsInt())
            dracoView = draco->second.Get("bufferView").Get<int>();
        const std::array<int, 4> data{attributeOf(primitive, "POSITION"), attributeOf(primitive, kIndicesKey),
                                      primitive.mode, dracoView};
        const auto [known, isNew] = imported_.try_emplace(data, uint32_t(scene_.meshes.size()));
        if (isNew) scene_.meshes.push_back(readGltfPrimitive(primitive, name, where, accessors_, buffers_));
        return known->second;
    }

    void addNode(const tinygltf::Node& node, int number, const Transform& world) {
        const std::vector<Part>& parts = partsOf(node.mesh, number);
        const std::vector<Transform> places = placements(node, number, world);
        if (scene_.instances.size() + uint64_t(places.size()) * parts.size() > maxInstances_)
            throw Error(ErrorKind::resources, document_.name + ": the scene has more than " +
                                                  std::to_string(maxInstances_) + " instances");
        for (const Transform& place : places)
            for (size_t i = 0; i < parts.size(); ++i) {
                const Part& part = parts[i];
                const bool ownName = part.name != scene_.meshes[part.mesh].name;
                scene_.instances.push_back({part.mesh, place, ownName ? part.name : "", i > 0});
            }
    }

    const GltfDocument& document_;
    GltfBuffers buffers_;
    GltfAccessors accessors_;
    uint64_t maxInstances_;
    ImportedScene scene_;
    std::map<int, std::vector<Part>> parts_;
    std::map<std::array<int, 4>, uint32_t> imported_;
};

}  // namespace

ImportedScene readGltf(std::span<const std::byte> bytes, const std::string& name,
                       const std::filesystem::path& directory) {
    const GltfDocument document = readGltfDocument(bytes, name);
    return SceneReader(document, directory, bytes.size()).read();
}

}  // namespace bvhio
