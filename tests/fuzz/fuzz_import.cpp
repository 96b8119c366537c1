// Fuzzes the scene importers. The first byte chooses the file name, so that kinds of files that are
// recognised by their names are tested, too.
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/error.h"
#include "importers/import.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static constexpr const char* kNames[] = {"x", "x.obj", "x.stl", "x.ply", "x.gltf", "x.glb", "x.drc"};
    if (size == 0) return 0;
    try {
        const std::span bytes(reinterpret_cast<const std::byte*>(data + 1), size - 1);
        // The directory does not exist, so external buffers are never found.
        bvhio::ImportedScene scene =
            bvhio::importBytes(bytes, kNames[data[0] % std::size(kNames)], "/nonexistent");
        uint64_t triangles = 0;
        for (const bvhio::Instance& instance : scene.instances)
            triangles += scene.meshes[instance.mesh].triangles.size();
        if (triangles < 1000000) bvhio::flatten(std::move(scene), {bvhio::OnDegenerate::drop});
    } catch (const bvhio::Error&) {
    }
    return 0;
}
