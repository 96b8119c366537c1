// tinygltf 2.7 turns the JSON into structures, but gets only the part that makes geometry, already checked.
// By itself it silently drops a primitive or a list of children that it cannot read, refuses primitives with
// Draco or sparse indices (their accessors have no buffer view), copies every buffer, reads every image, and
// recurses into nested `extras` without a limit.
#include <fstream>  // tinygltf's header uses it without including it

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_FS
#include <algorithm>
#include <climits>
#include <cstring>

#include "core/error.h"
#include "importers/gltf_document.h"

namespace bvhio {

namespace {

using Json = nlohmann::json;

constexpr int kMaxJsonDepth = 128;
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

[[noreturn]] void fail(const std::string& name, const std::string& what) {
    throw Error(ErrorKind::invalid, name + ": " + what);
}

[[noreturn]] void refuseVersion(const std::string& name, const std::string& version) {
    throw Error(ErrorKind::unsupported, name + ": the file is glTF " + version +
                                            ": convert it to glTF 2.0, the version that is read");
}

/// Splits a GLB into its JSON, which is returned, and its binary chunk.
std::span<const std::byte> splitGlb(std::span<const std::byte> bytes, GltfDocument& document) {
    const auto word = [&](size_t at) {
        uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    if (bytes.size() < 20) fail(document.name, "the GLB file is shorter than its headers");
    if (word(4) != 2) refuseVersion(document.name, word(4) == 1 ? "1.0" : std::to_string(word(4)));
    if (word(8) > bytes.size())
        fail(document.name, "the GLB file is cut short: it has " + std::to_string(bytes.size()) + " of " +
                                std::to_string(word(8)) + " bytes");
    bytes = bytes.first(word(8));
    std::span<const std::byte> json;
    for (size_t at = 12, chunk = 0; at + 8 <= bytes.size(); ++chunk) {
        const size_t size = word(at);
        const uint32_t type = word(at + 4);
        at += 8;
        if (size > bytes.size() - at) fail(document.name, "a chunk of the GLB file is longer than the file");
        if (chunk == 0 && type != kJsonChunk)
            fail(document.name, "the first chunk of the GLB file is not JSON");
        if (chunk == 0) json = bytes.subspan(at, size);
        if (chunk == 1 && type == kBinaryChunk) document.binaryChunk = bytes.subspan(at, size);
        at += std::min((size + 3) / 4 * 4, bytes.size() - at);
    }
    return json;
}

Json parse(std::span<const std::byte> text, const std::string& name) {
    const auto* begin = reinterpret_cast<const char*>(text.data());
    const auto bound = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > kMaxJsonDepth)
            fail(name, "the JSON is nested more than " + std::to_string(kMaxJsonDepth) + " levels deep");
        return true;
    };
    try {
        return Json::parse(begin, begin + text.size(), bound);
    } catch (const Json::parse_error& error) {
        fail(name, "the JSON is damaged at byte " + std::to_string(error.byte));
    }
}

enum class Type { index, size, indices, numbers, text, boolean, object };

/// A member that an object may have, and its type.
struct Member {
    const char* key;
    Type type;
    bool required = false;
};

bool isIndex(const Json& value) {
    return value.is_number_unsigned() && value.get<uint64_t>() <= INT_MAX;
}

bool hasType(const Json& value, Type type) {
    switch (type) {
        case Type::index:
            return isIndex(value);
        case Type::size:
            return value.is_number_unsigned() && value.get<uint64_t>() < uint64_t(1) << 53;
        case Type::indices:
            return value.is_array() && std::all_of(value.begin(), value.end(), isIndex);
        case Type::numbers:
            return value.is_array() &&
                   std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_number(); });
        case Type::text:
            return value.is_string();
        case Type::boolean:
            return value.is_boolean();
        case Type::object:
            return value.is_object();
    }
    return false;
}

/// Checks an object's members and removes those that are not listed.
void keepMembers(Json& object, std::initializer_list<Member> members, const std::string& where,
                 const std::string& name) {
    static constexpr const char* kTypeNames[] = {
        "an index", "a size", "a list of indices", "a list of numbers", "text", "true or false", "an object"};
    if (!object.is_object()) fail(name, where + " is not an object");
    Json kept = Json::object();
    for (const Member& member : members) {
        const auto it = object.find(member.key);
        if (it == object.end()) {
            if (member.required) fail(name, where + " has no '" + member.key + "'");
            continue;
        }
        if (!hasType(*it, member.type))
            fail(name, where + ": '" + member.key + "' is not " + kTypeNames[size_t(member.type)]);
        kept[member.key] = std::move(*it);
    }
    object = std::move(kept);
}

/// Keeps one extension of an object, and no other.
void keepExtension(Json& object, const char* extension) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end()) return;
    const auto it = extensions->find(extension);
    Json kept = it != extensions->end() && it->is_object() ? Json{{extension, *it}} : Json();
    if (kept.is_null())
        object.erase("extensions");
    else
        *extensions = std::move(kept);
}

void reducePrimitive(Json& primitive, const std::string& where, const std::string& name) {
    const Json& list = primitive.is_object() ? primitive.value("targets", Json()) : Json();
    const size_t targets = list.is_array() ? list.size() : 0;
    keepMembers(primitive,
                {{"attributes", Type::object, true},
                 {"indices", Type::index},
                 {"mode", Type::index},
                 {"extensions", Type::object}},
                where, name);
    keepMembers(primitive["attributes"], {{"POSITION", Type::index}}, where + ": 'attributes'", name);
    keepExtension(primitive, "KHR_draco_mesh_compression");
    if (const auto indices = primitive.find("indices"); indices != primitive.end()) {
        primitive["attributes"][kIndicesKey] = *indices;
        primitive.erase(indices);
    }
    if (targets > 0) primitive["attributes"][kTargetsKey] = targets;
}

/// Calls visit(element, "node 3") for each element of a list that the document may have.
template <class Visit>
void forEach(Json& document, const char* key, const char* singular, const std::string& name,
             const Visit& visit) {
    const auto list = document.find(key);
    if (list == document.end()) return;
    if (!list->is_array()) fail(name, "'" + std::string(key) + "' is not a list");
    for (size_t i = 0; i < list->size(); ++i)
        visit((*list)[i], std::string(singular) + " " + std::to_string(i));
}

void reduce(Json& json, const std::string& name) {
    forEach(json, "scenes", "scene", name, [&](Json& scene, const std::string& where) {
        keepMembers(scene, {{"nodes", Type::indices}}, where, name);
    });
    forEach(json, "nodes", "node", name, [&](Json& node, const std::string& where) {
        for (const char* key : {"skin", "camera"})  // these are only counted: damage there is harmless
            if (node.is_object() && node.contains(key) && !isIndex(node[key])) node.erase(key);
        keepMembers(node,
                    {{"children", Type::indices},
                     {"mesh", Type::index},
                     {"skin", Type::index},
                     {"camera", Type::index},
                     {"matrix", Type::numbers},
                     {"rotation", Type::numbers},
                     {"scale", Type::numbers},
                     {"translation", Type::numbers},
                     {"extensions", Type::object}},
                    where, name);
        keepExtension(node, "EXT_mesh_gpu_instancing");
    });
    forEach(json, "meshes", "mesh", name, [&](Json& mesh, const std::string& where) {
        if (!mesh.is_object() || !mesh.contains("primitives")) fail(name, where + " has no 'primitives'");
        forEach(mesh, "primitives", "primitive", name + ": " + where,
                [&](Json& primitive, const std::string& which) {
                    reducePrimitive(primitive, where + ", " + which, name);
                });
        Json kept{{"primitives", std::move(mesh["primitives"])}};
        if (const auto it = mesh.find("name"); it != mesh.end() && it->is_string()) kept["name"] = *it;
        mesh = std::move(kept);
    });
    forEach(json, "accessors", "accessor", name, [&](Json& accessor, const std::string& where) {
        keepMembers(accessor,
                    {{"bufferView", Type::index},
                     {"byteOffset", Type::size},
                     {"componentType", Type::index, true},
                     {"normalized", Type::boolean},
                     {"count", Type::size, true},
                     {"type", Type::text, true},
                     {"sparse", Type::object}},
                    where, name);
        const auto sparse = accessor.find("sparse");
        if (sparse == accessor.end()) return;
        keepMembers(
            *sparse,
            {{"count", Type::index, true}, {"indices", Type::object, true}, {"values", Type::object, true}},
            where + ": 'sparse'", name);
        const std::initializer_list<Member> view = {{"bufferView", Type::index, true},
                                                    {"byteOffset", Type::index}};
        keepMembers((*sparse)["values"], view, where + ": sparse 'values'", name);
        keepMembers((*sparse)["indices"],
                    {{"bufferView", Type::index, true},
                     {"byteOffset", Type::index},
                     {"componentType", Type::index, true}},
                    where + ": sparse 'indices'", name);
    });
    forEach(json, "bufferViews", "buffer view", name, [&](Json& view, const std::string& where) {
        keepMembers(view,
                    {{"buffer", Type::index, true},
                     {"byteOffset", Type::size},
                     {"byteLength", Type::size, true},
                     {"byteStride", Type::size},
                     {"extensions", Type::object}},
                    where, name);
        keepExtension(view, "EXT_meshopt_compression");
    });
    Json kept{{"asset", {{"version", "2.0"}}}};
    for (const char* key : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "scene"})
        if (const auto it = json.find(key); it != json.end()) kept[key] = std::move(*it);
    if (kept.contains("scene") && !isIndex(kept["scene"])) fail(name, "'scene' is not an index");
    json = std::move(kept);
}

void checkRequiredExtensions(const Json& json, const std::string& name) {
    // Extensions that are read, and those that change no triangle.
    static constexpr std::string_view kKnown[] = {
        "KHR_draco_mesh_compression",
        "KHR_mesh_quantization",
        "EXT_meshopt_compression",
        "EXT_mesh_gpu_instancing",
        "KHR_texture_transform",
        "KHR_texture_basisu",
        "EXT_texture_webp",
        "EXT_texture_avif",
        "MSFT_texture_dds",
        "KHR_lights_punctual",
        "EXT_lights_image_based",
        "KHR_xmp",
        "KHR_xmp_json_ld",
        "KHR_techniques_webgl",
        "KHR_animation_pointer",
        "EXT_texture_procedurals",
    };
    const auto required = json.find("extensionsRequired");
    if (required == json.end()) return;
    if (!required->is_array()) fail(name, "'extensionsRequired' is not a list");
    for (const Json& entry : *required) {
        if (!entry.is_string()) fail(name, "'extensionsRequired' holds something other than text");
        const auto extension = entry.get<std::string>();
        if (extension.starts_with("KHR_materials_")) continue;
        if (std::find(std::begin(kKnown), std::end(kKnown), extension) == std::end(kKnown))
            throw Error(ErrorKind::unsupported,
                        name + ": the file requires the extension " +
                            Json(extension).dump(-1, ' ', true, Json::error_handler_t::replace) +
                            ", which is not supported: export the scene without it");
    }
}

void checkVersion(const Json& json, const std::string& name) {
    const Json version = json.value("/asset/version"_json_pointer, Json());
    if (version.is_string() && version.get_ref<const std::string&>().starts_with("2.")) return;
    if (version.is_string()) refuseVersion(name, version.get<std::string>());
    // Version 1.0 has objects where 2.0 has lists, and need not say its version.
    for (const char* key : {"nodes", "meshes", "accessors"})
        if (json.contains(key) && json[key].is_object()) refuseVersion(name, "1.0");
    fail(name, "the glTF file has no 'asset' with a 'version'");
}

std::vector<GltfBufferSource> takeBuffers(Json& json, const std::string& name) {
    std::vector<GltfBufferSource> buffers;
    forEach(json, "buffers", "buffer", name, [&](Json& buffer, const std::string& where) {
        keepMembers(buffer, {{"uri", Type::text}, {"byteLength", Type::size, true}}, where, name);
        GltfBufferSource& source = buffers.emplace_back();
        source.byteLength = buffer["byteLength"].get<size_t>();
        if (buffer.contains("uri")) source.uri = std::move(buffer["uri"].get_ref<std::string&>());
    });
    json.erase("buffers");
    return buffers;
}

}  // namespace

GltfDocument readGltfDocument(std::span<const std::byte> bytes, const std::string& name) try {
    GltfDocument document;
    document.name = name;
    const bool binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
    const std::span<const std::byte> text = binary ? splitGlb(bytes, document) : bytes;

    std::string reduced;
    {
        Json json = parse(text, name);
        if (!json.is_object()) fail(name, "the JSON is not an object");
        checkVersion(json, name);
        checkRequiredExtensions(json, name);
        document.buffers = takeBuffers(json, name);
        reduce(json, name);
        reduced = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    std::string error, warning;
    tinygltf::TinyGLTF reader;
    if (reduced.size() > UINT_MAX ||
        !reader.LoadASCIIFromString(&document.model, &error, &warning, reduced.data(),
                                    unsigned(reduced.size()), "")) {
        std::replace(error.begin(), error.end(), '\n', ' ');
        fail(name, "the glTF file is damaged: " + error);
    }
    return document;
} catch (const Json::exception&) {
    // For example a number that no double holds, or a list instead of an object.
    fail(name, "the JSON does not have the structure of glTF");
}

}  // namespace bvhio
