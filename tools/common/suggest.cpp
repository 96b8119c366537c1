#include "common/suggest.h"

#include <algorithm>
#include <vector>

namespace bvhio {
namespace {

/// The Levenshtein distance: insertions, deletions and replacements from one word to the other.
size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

}  // namespace

std::string_view nearestName(std::string_view word, std::span<const std::string_view> names) {
    std::string_view nearest;
    size_t least = word.size() / 3 + 2;  // with more changes it is another word
    for (const std::string_view name : names) {
        const size_t distance = editDistance(word, name);
        if (distance < least && distance < name.size()) least = distance, nearest = name;
    }
    return nearest;
}

}  // namespace bvhio
