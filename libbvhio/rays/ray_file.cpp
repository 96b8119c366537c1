#include "rays/ray_file.h"

#include "rays/record_file.h"

namespace bvhio {

namespace {
constexpr char kRaySignature[9] = "BVHRAYS1";
}

std::vector<std::byte> encodeRays(std::span<const Ray> rays) {
    return encodeRecords(kRaySignature, rays);
}

std::vector<Ray> decodeRays(std::span<const std::byte> bytes, const std::string& name) {
    return decodeRecords<Ray>(kRaySignature, bytes, "rays", name);
}

}  // namespace bvhio
