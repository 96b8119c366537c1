#include "metrics/fetch_table.h"

namespace bvhio {

FetchTable::FetchTable(std::ostream& out, std::span<const uint32_t> order) : out_(out), order_(order) {
    out_ << "ray,array,offset,bytes\n";
}

void FetchTable::fetched(FetchedArray array, uint64_t offset, uint32_t bytes) {
    out_ << ray_ << ',' << kFetchedArrayNames[size_t(array)] << ',' << offset << ',' << bytes << '\n';
}

}  // namespace bvhio
