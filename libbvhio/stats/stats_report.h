// The statistics of a scene and its tree, without those of the file that they came from.
#pragma once

#include <optional>
#include <string>

#include "compress/forms.h"
#include "core/report_fwd.h"
#include "stats/epo.h"

namespace bvhio {

struct StatsOptions {
    SahCosts costs{};
    std::optional<EpoOptions> epo = EpoOptions{};  // nullopt leaves out EPO, by far the slowest part
};

/// Returns the keys of bvh-stats, in this order: form, layout, primitives (triangles), then those of
/// tree_stats.h and slack.h, epo, epo_exact, epo_sampled_triangles, epo_standard_error, those of
/// size_stats.h, topology_hash, bounds_hash and geometry_hash (as hashText writes them). If the form is not
/// exact, they describe the decoded tree. The caller adds the keys of the file: bytes.file, stored_bytes,
/// version, provenance and findings. An instanced scene also has meshes, instances and instanced_primitives
/// (those that hits number). Its epo is null, and it has no layout, slack or hashes of a tree.
Report statsReport(const Scene& scene, const EncodedBvh& encoded, const StatsOptions& options);

/// Returns a 64-bit hash as 16 hexadecimal digits, because JSON numbers lose bits beyond 2^53.
std::string hashText(uint64_t hash);

}  // namespace bvhio
