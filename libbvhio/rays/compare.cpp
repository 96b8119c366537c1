#include "rays/compare.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"

namespace bvhio {
namespace {

double relativeDifference(float a, float b) {
    if (a == b) return 0;  // equal infinities, too
    const double largest = std::max(std::fabs(double(a)), std::fabs(double(b)));
    const double difference = std::fabs(double(a) - b) / largest;
    return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

}  // namespace

HitComparison compareHits(std::span<const HitRecord> first, std::span<const HitRecord> second,
                          const CompareOptions& options) {
    if (first.size() != second.size())
        throw Error(ErrorKind::invalid, "hits of " + std::to_string(first.size()) + " and " +
                                            std::to_string(second.size()) +
                                            " rays cannot be compared: trace the same rays");
    HitComparison result;
    result.rays = first.size();
    for (size_t i = 0; i < first.size(); ++i) {
        const HitRecord &a = first[i], &b = second[i];
        if (std::memcmp(&a, &b, sizeof a) == 0) continue;
        const bool oneMisses = a.isMiss() != b.isMiss();
        double difference = 0;
        if (!a.isMiss() && !b.isMiss()) {
            difference = relativeDifference(a.t, b.t);
            result.maxRelativeT = std::max(result.maxRelativeT, difference);
        }
        if (!oneMisses && options.relativeTolerance > 0 && difference <= options.relativeTolerance) continue;
        ++result.differing;
        result.hitsAgainstMisses += oneMisses;
        if (result.listed.size() < options.maxListed) result.listed.push_back({i, a, b});
    }
    return result;
}

}  // namespace bvhio
