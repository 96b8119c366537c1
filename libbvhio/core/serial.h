// What core/parallel.h promises, on the calling thread alone: for a limit of one thread, and for a build
// without threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <utility>

#include "core/function_ref.h"

namespace bvhio::serial {

inline void chunks(size_t count, size_t grain, FunctionRef<void(size_t, size_t)> body) {
    for (size_t begin = 0; begin < count; begin += grain) body(begin, begin + std::min(grain, count - begin));
}

inline void inOrder(size_t count, FunctionRef<void(size_t, size_t)> make, FunctionRef<void(size_t)> place,
                    FunctionRef<void(size_t, size_t)> finish) {
    for (size_t i = 0; i < count; ++i) {
        make(i, 0);
        place(i);
        finish(i, 0);
    }
}

/// Runs tasks at once. After one has failed the others are left out, and wait() throws what that one threw.
class Tasks {
  public:
    void run(FunctionRef<void()> task) {
        if (failure_) return;
        try {
            task();
        } catch (...) {
            failure_ = std::current_exception();
        }
    }

    void wait() {
        if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    }

  private:
    std::exception_ptr failure_;
};

}  // namespace bvhio::serial
