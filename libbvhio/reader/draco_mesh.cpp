// importers/draco_mesh.h without Draco: geometry in Draco needs the full library.
#include "importers/draco_mesh.h"

#include "core/error.h"

namespace bvhio {

std::vector<std::byte> encodeDraco(std::span<const Vec3>, std::span<const TriangleIndices>, int) {
    throw Error(ErrorKind::unsupported, "writing geometry in Draco needs the full library libbvhio");
}

DracoMesh decodeDraco(std::span<const std::byte>, const std::string& where, std::optional<uint32_t>) {
    throw Error(ErrorKind::unsupported, where + " is in Draco, which needs the full library libbvhio");
}

}  // namespace bvhio
