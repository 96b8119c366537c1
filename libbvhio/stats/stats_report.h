// All that can be said of a scene and its tree without looking at the file they came from.
#pragma once

#include <optional>
#include <string>

#include "compress/forms.h"
#include "core/report.h"
#include "stats/epo.h"

namespace bvhio {

struct StatsOptions {
    SahCosts costs{};
    std::optional<EpoOptions> epo = EpoOptions{};  // none: leave EPO out, by far the slowest part
};

/// The keys of bvh-stats, in this order: form, layout, primitives (triangles), then those of tree_stats.h
/// and slack.h, epo, epo_exact, epo_sampled_triangles, epo_standard_error, those of size_stats.h,
/// topology_hash, bounds_hash and geometry_hash (as hashText writes them). For a form that is not exact they
/// speak of the decoded tree. Sizes of and in the file, its version, provenance and findings are for the
/// caller to add: bytes.file, stored_bytes, version, provenance and findings. An instanced scene has meshes,
/// instances and instanced_primitives (those that hits number) too, epo null, and neither layout, slack nor
/// hashes of a tree.
Report statsReport(const Scene& scene, const EncodedBvh& encoded, const StatsOptions& options);

/// A 64-bit hash as 16 hexadecimal digits: JSON numbers lose bits beyond 2^53.
std::string hashText(uint64_t hash);

}  // namespace bvhio
