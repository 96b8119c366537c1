// Writes the fetches of a run as a table, to draw the effect of a layout or as input of another model.
#pragma once

#include <ostream>

#include "metrics/fetches.h"

namespace bvhio {

/// Writes the line "ray,array,offset,bytes", and then one line for each fetch: the ray's number in the set,
/// the array's name, the offset of the fetch in the array, and its length.
class FetchTable : public FetchListener {
  public:
    /// `order` gives the number of the ray that is traced i-th.
    FetchTable(std::ostream& out, std::span<const uint32_t> order);

    void rayBegins(size_t index) override { ray_ = order_[index]; }
    void fetched(FetchedArray array, uint64_t offset, uint32_t bytes) override;

  private:
    std::ostream& out_;
    std::span<const uint32_t> order_;
    uint32_t ray_ = 0;
};

}  // namespace bvhio
