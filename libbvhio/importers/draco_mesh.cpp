// Encoding uses Draco's sequential method: only that one keeps the order of vertices and triangles, which hit
// files and the BVH's primitive ids rely on. Decoding reads every method, through subclasses of Draco's
// decoders that compare the counts in the data with its size before Draco allocates memory for them: Draco
// itself trusts the number of points of a sequential mesh and the number of faces of an edgebreaker mesh.
#include "importers/draco_mesh.h"

#include <draco/compression/expert_encode.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

#include <cmath>
#include <new>
#include <stdexcept>

#include "core/aabb.h"
#include "core/error.h"
#include "core/plural.h"

namespace bvhio {

namespace {

// Entropy coding can make a regular mesh much smaller than a bit per face, so there is no exact bound. The
// densest mesh that was tried, a flat grid of 2 million equal triangles at Draco's slowest speed, has 40
// faces and 20 points per byte.
constexpr uint64_t kMaxFacesPerByte = 64;
constexpr uint64_t kMaxPointsPerByte = 64;
constexpr uint64_t kFreeCount = 4096;                 // small meshes are harmless
constexpr uint64_t kMaxAttributeBytesPerPoint = 256;  // all attributes of a point together, as decoded

bool plausible(uint64_t count, uint64_t perByte, int64_t bytesLeft) {
    return count <= kFreeCount + perByte * uint64_t(bytesLeft);
}

/// Reads a count as the given bitstream version stores it: before 2.0 as four bytes.
bool readCount(draco::DecoderBuffer& buffer, uint16_t version, uint32_t& count) {
    return version < DRACO_BITSTREAM_VERSION(2, 0) ? buffer.Decode(&count)
                                                   : draco::DecodeVarint(&count, &buffer);
}

/// The counts at the head of sequential connectivity. Takes a copy of the buffer: Draco reads them again.
bool readCounts(const draco::MeshSequentialDecoder&, draco::DecoderBuffer buffer, uint16_t version,
                uint32_t& faces, uint32_t& points) {
    if (version < DRACO_BITSTREAM_VERSION(2, 2)) return buffer.Decode(&faces) && buffer.Decode(&points);
    return draco::DecodeVarint(&faces, &buffer) && draco::DecodeVarint(&points, &buffer);
}

/// The same for edgebreaker connectivity.
bool readCounts(const draco::MeshEdgebreakerDecoder&, draco::DecoderBuffer buffer, uint16_t version,
                uint32_t& faces, uint32_t& points) {
    uint32_t newVertices = 0;
    if (version < DRACO_BITSTREAM_VERSION(2, 2) && !readCount(buffer, version, newVertices)) return false;
    return readCount(buffer, version, points) && readCount(buffer, version, faces);
}

/// One of Draco's mesh decoders, with checks before it allocates.
template <class Base>
class BoundedDecoder : public Base {
  protected:
    bool DecodeConnectivity() override {
        uint32_t faces = 0, points = 0;
        if (!readCounts(*this, *this->buffer(), this->bitstream_version(), faces, points)) return false;
        const int64_t bytesLeft = this->buffer()->remaining_size();
        return plausible(faces, kMaxFacesPerByte, bytesLeft) &&
               plausible(points, kMaxPointsPerByte, bytesLeft) && Base::DecodeConnectivity();
    }
    bool DecodeAllAttributes() override {
        uint64_t bytesPerPoint = 0;
        for (int i = 0; i < this->point_cloud()->num_attributes(); ++i)
            bytesPerPoint += uint64_t(this->point_cloud()->attribute(i)->byte_stride());
        return bytesPerPoint <= kMaxAttributeBytesPerPoint && Base::DecodeAllAttributes();
    }
};

draco::Status decodeInto(draco::Mesh& mesh, std::span<const std::byte> bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DecoderBuffer headerBuffer(buffer);
    draco::DracoHeader header;
    DRACO_RETURN_IF_ERROR(draco::PointCloudDecoder::DecodeHeader(&headerBuffer, &header))
    if (header.encoder_type != draco::TRIANGULAR_MESH)
        return {draco::Status::DRACO_ERROR, "it holds points, not triangles"};
    const draco::DecoderOptions options;
    if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING)
        return BoundedDecoder<draco::MeshSequentialDecoder>().Decode(options, &buffer, &mesh);
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
        return BoundedDecoder<draco::MeshEdgebreakerDecoder>().Decode(options, &buffer, &mesh);
    return {draco::Status::DRACO_ERROR, "its encoding method is not known"};
}

std::vector<std::byte> encode(const draco::Mesh& mesh, int positionBits, bool compressed) {
    draco::ExpertEncoder encoder(mesh);
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    encoder.SetAttributeQuantization(0, positionBits);
    encoder.SetUseBuiltInAttributeCompression(compressed);
    encoder.options().SetGlobalBool("compress_connectivity", compressed);
    draco::EncoderBuffer buffer;
    const draco::Status status = encoder.EncodeToBuffer(&buffer);
    if (!status.ok())
        throw Error(ErrorKind::unsupported, "Draco cannot encode this mesh: " + status.error_msg_string());
    const auto* begin = reinterpret_cast<const std::byte*>(buffer.data());
    return {begin, begin + buffer.size()};
}

}  // namespace

std::vector<std::byte> encodeDraco(std::span<const Vec3> vertices, std::span<const TriangleIndices> triangles,
                                   int positionBits) {
    if (positionBits < 1 || positionBits > kMaxDracoPositionBits)
        throw Error(ErrorKind::usage,
                    "Draco position bits must be 1 to " + std::to_string(kMaxDracoPositionBits));
    if (vertices.size() > 3 * triangles.size())
        throw Error(ErrorKind::unsupported,
                    "Draco cannot hold more than three vertices per triangle: store the geometry raw");
    Aabb bounds = Aabb::empty();
    for (const Vec3& v : vertices) bounds.extend(v);
    if (!isFinite(bounds.extent()))
        throw Error(ErrorKind::unsupported,
                    "the scene is too large for Draco's quantisation: store the geometry raw");

    draco::Mesh mesh;
    mesh.set_num_points(uint32_t(vertices.size()));
    draco::GeometryAttribute position;
    position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, sizeof(Vec3), 0);
    const int id = mesh.AddAttribute(position, true, uint32_t(vertices.size()));
    mesh.attribute(id)->buffer()->Write(0, vertices.data(), vertices.size_bytes());
    mesh.SetNumFaces(triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i) {
        const TriangleIndices& t = triangles[i];
        mesh.SetFace(draco::FaceIndex(uint32_t(i)),
                     {draco::PointIndex(t.v0), draco::PointIndex(t.v1), draco::PointIndex(t.v2)});
    }

    std::vector<std::byte> bytes = encode(mesh, positionBits, true);
    // Draco refuses to decode indices of less than three bytes per triangle, so a mesh that compresses better
    // than that (thousands of equal triangles) is stored without entropy coding.
    const size_t header = 32;
    if (bytes.size() < header + 3 * triangles.size()) bytes = encode(mesh, positionBits, false);
    return bytes;
}

DracoMesh decodeDraco(std::span<const std::byte> bytes, const std::string& where,
                      std::optional<uint32_t> positionAttribute) try {
    draco::Mesh mesh;
    const draco::Status status = decodeInto(mesh, bytes);
    if (!status.ok())
        throw Error(ErrorKind::invalid, where + ": the Draco data is damaged: " + status.error_msg_string());
    const int id = positionAttribute ? mesh.GetAttributeIdByUniqueId(*positionAttribute)
                                     : mesh.GetNamedAttributeId(draco::GeometryAttribute::POSITION);
    if (id < 0 || mesh.attribute(id)->num_components() != 3)
        throw Error(ErrorKind::invalid, where + ": the Draco data has no positions of three components");
    draco::PointAttribute* positions = mesh.attribute(id);
    positions->set_normalized(false);

    DracoMesh result;
    result.vertices.resize(mesh.num_points());
    for (uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = positions->mapped_index(draco::PointIndex(i));
        Vec3& v = result.vertices[i];
        if (value.value() >= positions->size() || !positions->ConvertValue<float, 3>(value, &v.x) ||
            !isFinite(v))
            throw Error(ErrorKind::invalid,
                        where + ": vertex " + std::to_string(i) + " of the Draco data is not finite");
        v = v + Vec3{};  // -0 + 0 is +0
    }
    result.triangles.resize(mesh.num_faces());
    for (uint32_t i = 0; i < mesh.num_faces(); ++i) {
        const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
        for (const draco::PointIndex& corner : face)
            if (corner.value() >= mesh.num_points())
                throw Error(ErrorKind::invalid, where + ": triangle " + std::to_string(i) +
                                                    " of the Draco data uses vertex " +
                                                    std::to_string(corner.value()) + ", but it has only " +
                                                    counted(mesh.num_points(), "vertex", "vertices"));
        result.triangles[i] = {face[0].value(), face[1].value(), face[2].value()};
    }
    return result;
} catch (const std::length_error&) {
    throw Error(ErrorKind::invalid, where + ": the Draco data is damaged: it claims impossible sizes");
}

}  // namespace bvhio
