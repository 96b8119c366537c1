// Large uninitialised arrays. Whoever allocates one must write every element before reading it.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

#include "core/shared_array.h"

namespace bvhio {

/// Allocates memory aligned to cache lines, and in huge pages where the system grants them: first touches of
/// small pages cost about as much as a pass over the data. Throws std::bad_alloc. The pointer frees it.
std::shared_ptr<void> allocateUncleared(size_t bytes);

/// An owned array of plain data. T's constructors are not called (Node's would write zeros).
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    Buffer() = default;
    explicit Buffer(size_t size)
        : memory_(allocateUncleared(size * sizeof(T))), data_(static_cast<T*>(memory_.get())), size_(size) {}

    T* data() { return data_; }
    const T* data() const { return data_; }
    size_t size() const { return size_; }
    T& operator[](size_t i) { return data_[i]; }
    const T& operator[](size_t i) const { return data_[i]; }

    /// Keeps the first `size` elements. The rest never took memory if nothing was written there.
    void truncate(size_t size) { size_ = size; }

    /// Converts the array into an immutable one, without copying.
    SharedArray<T> share() && { return {std::move(memory_), {data_, size_}}; }

  private:
    std::shared_ptr<void> memory_;
    T* data_ = nullptr;
    size_t size_ = 0;
};

}  // namespace bvhio
