#include "compress/candidates.h"

namespace bvhio {

namespace {

EncodingCandidate twoLevel(std::string_view parameters, TlasForm tlasForm, BlasForm blasForm,
                           uint32_t blasSize) {
    EncodeOptions options;
    options.tlasForm = tlasForm;
    options.blasForm = blasForm;
    options.blasSize = blasSize;
    return {"two-level", parameters, options};
}

}  // namespace

std::span<const EncodingCandidate> encodingCandidates() {
    static const EncodingCandidate kTable[] = {
        {"aabb", ""},
        {"quantized", ""},
        {"quantized-short", ""},
        {"ssh", ""},
        {"mvh", ""},
        {"mvh", "--leaf-size 8", {.leafSize = 8}},
        {"mvh", "--leaf-size 16", {.leafSize = 16}},
        twoLevel("--tlas-form quantized --blas-form mvh --blas-size 16", TlasForm::quantized, BlasForm::mvh,
                 16),
        twoLevel("--tlas-form quantized --blas-form mvh --blas-size 80", TlasForm::quantized, BlasForm::mvh,
                 80),
        twoLevel("--tlas-form quantized --blas-form mvh --blas-size 128", TlasForm::quantized, BlasForm::mvh,
                 128),
        twoLevel("--tlas-form aabb --blas-form mvh --blas-size 16", TlasForm::aabb, BlasForm::mvh, 16),
        twoLevel("--tlas-form aabb --blas-form ssh --blas-size 16", TlasForm::aabb, BlasForm::ssh, 16),
        twoLevel("--tlas-form aabb --blas-form ssh --blas-size 32", TlasForm::aabb, BlasForm::ssh, 32),
        twoLevel("--tlas-form aabb --blas-form ssh --blas-size 64", TlasForm::aabb, BlasForm::ssh, 64),
    };
    return kTable;
}

}  // namespace bvhio
