// A reference to something callable: lets a function that takes one live in a .cpp file.
#pragma once

#include <type_traits>
#include <utility>

namespace bvhio {

template <class Signature>
class FunctionRef;

/// Calls what it was made from, which must outlive it. Copying it copies two pointers.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
  public:
    template <class Callable>
    requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef>) FunctionRef(Callable&& callable)
        : callable_(const_cast<void*>(static_cast<const void*>(&callable))),
          call_([](void* target, Arguments... arguments) -> Result {
              return (*static_cast<std::remove_reference_t<Callable>*>(target))(
                  std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const {
        return call_(callable_, std::forward<Arguments>(arguments)...);
    }

  private:
    void* callable_;
    Result (*call_)(void*, Arguments...);
};

}  // namespace bvhio
