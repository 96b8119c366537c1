// The fetches of a run as a table: to draw what a layout does, or to feed another model.
#pragma once

#include <ostream>

#include "metrics/fetches.h"

namespace bvhio {

/// Writes the line "ray,array,offset,bytes", then one for each fetch as it comes: the ray's number in the
/// set, the array's name, where the fetch begins in it, and how long it is.
class FetchTable : public FetchListener {
  public:
    /// `order` has the number of the ray that is traced i-th.
    FetchTable(std::ostream& out, std::span<const uint32_t> order);

    void rayBegins(size_t index) override { ray_ = order_[index]; }
    void fetched(FetchedArray array, uint64_t offset, uint32_t bytes) override;

  private:
    std::ostream& out_;
    std::span<const uint32_t> order_;
    uint32_t ray_ = 0;
};

}  // namespace bvhio
