#include "importers/import.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "container/container_format.h"
#include "core/error.h"
#include "importers/draco_mesh.h"
#include "importers/gltf_import.h"
#include "importers/mesh_import.h"
#include "importers/read_file.h"
#include "importers/text_cursor.h"

namespace bvhio {

namespace {

/// `mismatched` is a file whose content is not what its extension promises.
enum class Kind { glb, gltf, obj, ply, stl, draco, container, utf16, mismatched, unknown };

std::string extensionOf(const std::string& name) {
    std::string extension = std::filesystem::path(name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

/// Whether the first word outside comments is one that OBJ files begin with.
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

bool beginsContainer(std::string_view text) {
    return text.size() >= kSignature.size() &&
           std::equal(kSignature.begin(), kSignature.end(), text.begin(),
                      [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); });
}

Kind findKind(std::span<const std::byte> bytes, const std::string& name) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("glTF")) return Kind::glb;
    if (beginsContainer(text)) return Kind::container;
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
        return Kind::mismatched;
    return looksLikeObj(bytes) ? Kind::obj : Kind::unknown;
}

ImportedScene sceneOf(Mesh mesh, const LeftOut& leftOut = {}) {
    mesh.name.clear();  // the same bytes must give the same scene from a file of any name and from a pipe
    ImportedScene scene;
    scene.leftOut = leftOut;
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
    LeftOut leftOut;
    switch (findKind(bytes, name)) {
        case Kind::glb:
        case Kind::gltf:
            return readGltf(bytes, name, directory);
        case Kind::obj: {
            Mesh mesh = readObj(bytes, name, leftOut);
            return sceneOf(std::move(mesh), leftOut);
        }
        case Kind::ply: {
            Mesh mesh = readPly(bytes, name, leftOut);
            return sceneOf(std::move(mesh), leftOut);
        }
        case Kind::stl:
            return sceneOf(readStl(bytes, name));
        case Kind::draco: {
            DracoMesh mesh = decodeDraco(bytes, name);
            return sceneOf({name, std::move(mesh.vertices), std::move(mesh.triangles)});
        }
        case Kind::container:
            throw Error(ErrorKind::unsupported,
                        name + ": is a .bvhx already: give the scene that it was made from");
        case Kind::mismatched:
            throw Error(ErrorKind::invalid,
                        name + ": the content is not that of a " + extensionOf(name) + " file");
        case Kind::utf16:
            throw Error(ErrorKind::unsupported, name + ": the file is UTF-16 text: save it as UTF-8");
        case Kind::unknown:
            break;
    }
    throw Error(ErrorKind::unsupported, name + ": is not a glTF, GLB, OBJ, PLY, STL or Draco file");
}

ImportedScene importFile(const std::filesystem::path& path) {
    return importBytes(readFile(path), path.string(), path.parent_path());
}

std::string_view sceneKind(std::span<const std::byte> bytes, const std::string& name) {
    switch (findKind(bytes, name)) {
        case Kind::glb:
            return "GLB";
        case Kind::gltf:
            return "glTF";
        case Kind::obj:
            return "OBJ";
        case Kind::ply:
            return "PLY";
        case Kind::stl:
            return "STL";
        case Kind::draco:
            return "Draco";
        default:
            return "";
    }
}

}  // namespace bvhio
