#include "trace/ray_file.h"

#include "trace/record_file.h"

namespace bvhio {

namespace {
constexpr char kSignature[9] = "BVHRAYS1";
}

std::vector<std::byte> encodeRays(std::span<const Ray> rays) {
    return encodeRecords(kSignature, rays);
}

std::vector<Ray> decodeRays(std::span<const std::byte> bytes, const std::string& name) {
    return decodeRecords<Ray>(kSignature, bytes, "rays", name);
}

}  // namespace bvhio
