#include "importers/import.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "core/error.h"
#include "importers/draco_mesh.h"
#include "importers/gltf_import.h"
#include "importers/mesh_import.h"
#include "importers/read_file.h"
#include "importers/text_cursor.h"

namespace bvhio {

namespace {

enum class Kind { gltf, obj, ply, stl, draco, utf16, unknown };

std::string extensionOf(const std::string& name) {
    std::string extension = std::filesystem::path(name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

/// Whether the first word that is no comment is one that OBJ files begin with.
bool looksLikeObj(std::span<const std::byte> bytes) {
    TextCursor cursor(bytes);
    for (cursor.skipSpace(); !cursor.atEnd(); cursor.skipSpace()) {
        const std::string_view word = cursor.word();
        if (!word.starts_with('#')) {
            for (const char* keyword : {"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"})
                if (word == keyword) return true;
            return false;
        }
        cursor.skipLine();
    }
    return false;
}

Kind findKind(std::span<const std::byte> bytes, const std::string& name) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("glTF")) return Kind::gltf;
    if (text.starts_with("DRACO")) return Kind::draco;
    if (text.starts_with("ply\n") || text.starts_with("ply\r") || text.starts_with("ply ")) return Kind::ply;
    if (text.starts_with("\xfe\xff") || text.starts_with("\xff\xfe")) return Kind::utf16;

    TextCursor cursor(bytes);
    cursor.skipSpace();
    const std::string extension = extensionOf(name);
    if (text.substr(cursor.offset()).starts_with('{')) return Kind::gltf;
    if (extension == ".obj") return Kind::obj;
    if (isBinaryStl(bytes) || cursor.word() == "solid" || extension == ".stl") return Kind::stl;
    if (extension == ".gltf" || extension == ".glb" || extension == ".ply" || extension == ".drc")
        throw Error(ErrorKind::invalid,
                    name + ": the file does not begin as a " + extension.substr(1) + " file does");
    return looksLikeObj(bytes) ? Kind::obj : Kind::unknown;
}

ImportedScene sceneOf(Mesh mesh) {
    mesh.name.clear();  // a file's name is no content: the same bytes come from a pipe
    ImportedScene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.emplace_back();
    return scene;
}

}  // namespace

ImportedScene importBytes(std::span<const std::byte> bytes, const std::string& name,
                          const std::filesystem::path& directory) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xef\xbb\xbf")) bytes = bytes.subspan(3);  // the mark of UTF-8
    if (bytes.empty()) throw Error(ErrorKind::invalid, name + ": the file is empty");
    switch (findKind(bytes, name)) {
        case Kind::gltf:
            return readGltf(bytes, name, directory);
        case Kind::obj:
            return sceneOf(readObj(bytes, name));
        case Kind::ply:
            return sceneOf(readPly(bytes, name));
        case Kind::stl:
            return sceneOf(readStl(bytes, name));
        case Kind::draco: {
            DracoMesh mesh = decodeDraco(bytes, name);
            return sceneOf({name, std::move(mesh.vertices), std::move(mesh.triangles)});
        }
        case Kind::utf16:
            throw Error(ErrorKind::unsupported, name + ": the file is UTF-16 text: save it as UTF-8");
        case Kind::unknown:
            break;
    }
    throw Error(ErrorKind::unsupported, name + ": the file is no glTF, GLB, OBJ, PLY, STL or Draco file");
}

ImportedScene importFile(const std::filesystem::path& path) {
    return importBytes(readFile(path), path.filename().string(), path.parent_path());
}

}  // namespace bvhio
