#include "trace/tune.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>

#include "compress/forms.h"
#include "core/parallel.h"
#include "rays/ray_sets.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

/// Returns the processor time of this thread in seconds.
double threadSeconds() {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// A tree that rays are traced through.
struct Contestant {
    EncodedBvh bvh;
    Tracer tracer;
    Contestant(const Scene& scene, EncodedBvh encoded) : bvh(std::move(encoded)), tracer(scene, bvh) {}

    double seconds(std::span<const Ray> rays, std::span<Hit> hits) const {
        const double before = threadSeconds();
        tracer.closestHits(rays, hits);
        return threadSeconds() - before;
    }
};

struct Times {
    double reference, candidate;  // medians in seconds
    double slowdown() const { return reference > 0 ? candidate / reference : 1; }
};

/// From this slowdown on, one round is enough: noise is comparatively small, and a round takes long.
constexpr double kManyTimes = 8;

/// Times both in alternation on one thread.
Times timeBoth(const Contestant& reference, const Contestant& candidate, std::span<const Ray> rays,
               uint32_t rounds) {
    const ThreadLimit oneThread(1);
    std::vector<Hit> hits(rays.size());
    std::vector<double> times[2];
    for (uint32_t round = 0; round < rounds; ++round) {
        times[0].push_back(reference.seconds(rays, hits));
        times[1].push_back(candidate.seconds(rays, hits));
        if (times[1][0] > kManyTimes * times[0][0]) break;
    }
    return {median(times[0]), median(times[1])};
}

class Tuner {
  public:
    Tuner(const Scene& scene, const Bvh& bvh, const TuneOptions& options)
        : scene_(scene), bvh_(bvh), options_(options), aabb_(scene, AabbForm(bvh)) {
        const ClosestHits closestHits = [&](std::span<const Ray> rays) {
            std::vector<Hit> hits(rays.size());
            aabb_.tracer.closestHits(rays, hits);
            return hits;
        };
        const RaySetOptions sample{.count = options.rays, .seed = options.seed};
        primary_ = makeRaySet("primary", scene, sample, closestHits).rays;
        diffuse_ = makeRaySet("diffuse", scene, sample, closestHits).rays;
    }

    TunedEncoding measure(const EncodingCandidate& candidate) const {
        TunedEncoding row{candidate};
        std::optional<Contestant> made;
        const auto& form = choose(forms(), "form", candidate.form);
        try {
            made.emplace(scene_, form.function(scene_, bvh_, candidate.options));
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::unsupported) throw;
            row.refusal = error.what();
            return row;
        }
        row.nodeBytes = std::visit([](const auto& f) { return f.nodeBytes(); }, made->bvh);
        row.bytesPerPrimitive = double(row.nodeBytes) / double(scene_.triangles.size());

        TraversalCounts counts = made->tracer.measure(primary_, QueryKind::closest).counts;
        counts.add(made->tracer.measure(diffuse_, QueryKind::closest).counts);
        row.nc = counts.nc();
        row.blb = counts.blb();

        const Times primary = timeBoth(aabb_, *made, primary_, options_.rounds);
        const Times diffuse = timeBoth(aabb_, *made, diffuse_, options_.rounds);
        const double seconds = primary.candidate + diffuse.candidate;
        row.mraysPerSecond = seconds > 0 ? double(counts.rays) / seconds / 1e6 : 0;
        if (candidate.form == encodingCandidates()[0].form) return row;  // the reference itself
        row.slowdownPrimary = primary.slowdown();
        row.slowdownDiffuse = diffuse_.empty() ? row.slowdownPrimary : diffuse.slowdown();
        row.slowdown = std::sqrt(row.slowdownPrimary * row.slowdownDiffuse);
        return row;
    }

  private:
    const Scene& scene_;
    const Bvh& bvh_;
    const TuneOptions& options_;
    Contestant aabb_;
    std::vector<Ray> primary_, diffuse_;
};

/// Returns the least of the rows that qualify.
template <class Qualifies, class Less>
const TunedEncoding* least(std::span<const TunedEncoding> rows, const Qualifies& qualifies,
                           const Less& less) {
    const TunedEncoding* best = nullptr;
    for (const TunedEncoding& row : rows)
        if (row.refusal.empty() && qualifies(row) && (best == nullptr || less(row, *best))) best = &row;
    return best;
}

/// Quotes a text, which may contain commas and quotes, for CSV.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

}  // namespace

std::vector<TunedEncoding> measureEncodings(const Scene& scene, const Bvh& bvh,
                                            std::span<const EncodingCandidate> candidates,
                                            const TuneOptions& options) {
    if (options.progress != nullptr) options.progress->start(candidates.size());
    const Tuner tuner(scene, bvh, options);
    std::vector<TunedEncoding> rows;
    for (const EncodingCandidate& candidate : candidates) {
        rows.push_back(tuner.measure(candidate));
        if (options.progress != nullptr) options.progress->add(1);
    }
    return rows;
}

bool isDominated(const TunedEncoding& row, std::span<const TunedEncoding> rows) {
    return std::any_of(rows.begin(), rows.end(), [&](const TunedEncoding& other) {
        return other.refusal.empty() && other.bytesPerPrimitive <= row.bytesPerPrimitive &&
               other.slowdown <= row.slowdown &&
               (other.bytesPerPrimitive < row.bytesPerPrimitive || other.slowdown < row.slowdown);
    });
}

const TunedEncoding* fastestWithin(std::span<const TunedEncoding> rows, double maxBytesPerPrimitive) {
    return least(
        rows, [&](const TunedEncoding& row) { return row.bytesPerPrimitive <= maxBytesPerPrimitive; },
        [](const TunedEncoding& a, const TunedEncoding& b) {
            return a.slowdown != b.slowdown ? a.slowdown < b.slowdown
                                            : a.bytesPerPrimitive < b.bytesPerPrimitive;
        });
}

const TunedEncoding* smallestWithin(std::span<const TunedEncoding> rows, double maxSlowdown) {
    return least(
        rows, [&](const TunedEncoding& row) { return row.slowdown <= maxSlowdown; },
        [](const TunedEncoding& a, const TunedEncoding& b) {
            return a.bytesPerPrimitive != b.bytesPerPrimitive ? a.bytesPerPrimitive < b.bytesPerPrimitive
                                                              : a.slowdown < b.slowdown;
        });
}

std::string csvOf(std::span<const TunedEncoding> rows, const TunedEncoding* chosen) {
    std::string csv =
        "form,parameters,bytes_per_primitive,NC,BLB,mrays_per_second,slowdown,slowdown_primary,"
        "slowdown_diffuse,status\n";
    for (const TunedEncoding& row : rows) {
        csv += std::string(row.candidate.form) + ',' + std::string(row.candidate.parameters);
        if (!row.refusal.empty()) {
            csv += ",,,,,,,," + quoted(row.refusal) + '\n';
            continue;
        }
        for (const double value : {row.bytesPerPrimitive, row.nc, row.blb, row.mraysPerSecond, row.slowdown,
                                   row.slowdownPrimary, row.slowdownDiffuse}) {
            char text[32];
            std::snprintf(text, sizeof text, ",%.6g", value);
            csv += text;
        }
        csv += &row == chosen ? ",chosen\n" : isDominated(row, rows) ? ",dominated\n" : ",frontier\n";
    }
    return csv;
}

}  // namespace bvhio
