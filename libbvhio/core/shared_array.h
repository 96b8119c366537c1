// Immutable arrays that either own their elements or view a mapped file, and the aligned vectors that they
// are made from.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace bvhio {

/// Aligns to cache lines, so that a sibling pair of 32-byte nodes never straddles two lines. Leaves plain
/// data uninitialised on resize: builders overwrite every element, and clearing 100 MB first costs more than
/// some of their passes.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{64};

    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&) {}

    T* allocate(size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlignment)); }
    void deallocate(T* p, size_t) { ::operator delete(p, kAlignment); }
    template <class U>
    void construct(U* p) {
        // Default-initialised: plain data without member initialisers is not cleared.
        ::new (static_cast<void*>(p)) U;
    }
    template <class U, class... Args>
    void construct(U* p, Args&&... args) {
        ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
    }
    template <class U>
    bool operator==(const AlignedAllocator<U>&) const {
        return true;
    }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// A read-only array that shares ownership of its storage, which is a vector that was moved in or a mapped
/// file. Copies are cheap.
template <class T>
class SharedArray {
  public:
    SharedArray() = default;
    /// Takes over a vector; nothing is copied.
    template <class Allocator>
    SharedArray(std::vector<T, Allocator>&&
                    storage) {  // NOLINT: implicit on purpose, `bvh.nodes = std::move(vector)`
        auto owner = std::make_shared<std::vector<T, Allocator>>(std::move(storage));
        view_ = {owner->data(), owner->size()};
        owner_ = std::move(owner);
    }
    /// Views memory that `owner` keeps alive.
    SharedArray(std::shared_ptr<const void> owner, std::span<const T> view)
        : owner_(std::move(owner)), view_(view) {}

    const T* data() const { return view_.data(); }
    size_t size() const { return view_.size(); }
    bool empty() const { return view_.empty(); }
    const T& operator[](size_t i) const { return view_[i]; }
    const T* begin() const { return view_.data(); }
    const T* end() const { return view_.data() + view_.size(); }
    /// Returns the owner of the storage, for a view of the same bytes as another type.
    const std::shared_ptr<const void>& owner() const { return owner_; }
    operator std::span<const T>() const { return view_; }  // NOLINT: a SharedArray is used wherever a span is

  private:
    std::shared_ptr<const void> owner_;
    std::span<const T> view_;
};

}  // namespace bvhio
