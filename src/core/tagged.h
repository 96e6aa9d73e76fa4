// Closed unions of small values: what runs per ray is a value, not an interface. A family's class holds an aligned byte
// buffer and a tag; a header beside it lists the types, and its one .cpp dispatches through the switch below, so that a
// new model does not recompile the world. (std::visit turns into indirect calls beyond eleven alternatives.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

#include "core/fn.h"

namespace etd {

template <class... Ts>
struct TypeList {
  static constexpr size_t kCount = sizeof...(Ts);
  static constexpr size_t kMaxSize = std::max({sizeof(Ts)...});
  static constexpr size_t kMaxAlign = std::max({alignof(Ts)...});
  static constexpr bool kTrivial = (std::is_trivially_copyable_v<Ts> && ...);

  template <class T>
  static constexpr uint32_t index_of() {
    uint32_t i = 0;
    const bool found = ((std::is_same_v<T, Ts> ? true : (++i, false)) || ...);
    return found ? i : static_cast<uint32_t>(kCount);
  }
};

namespace detail {

template <class... Lists>
struct Joined;
template <class... Ts>
struct Joined<TypeList<Ts...>> {
  using Type = TypeList<Ts...>;
};
template <class... As, class... Bs, class... Rest>
struct Joined<TypeList<As...>, TypeList<Bs...>, Rest...> : Joined<TypeList<As..., Bs...>, Rest...> {};

}  // namespace detail

// One list of all types of several.
template <class... Lists>
using JoinedList = typename detail::Joined<Lists...>::Type;

// An aligned buffer for one value of a family, with its tag.
template <size_t Size, size_t Align = 16>
struct TaggedStorage {
  alignas(Align) std::byte bytes[Size];
  uint32_t tag = 0;

  template <class List, class T>
  void store(const T& value) {
    static_assert(List::kTrivial, "a family's members are trivially copyable");
    static_assert(List::kMaxSize <= Size && List::kMaxAlign <= Align, "the family's buffer is too small");
    static_assert(List::template index_of<T>() < List::kCount, "the type is not in the family's list");
    ::new (static_cast<void*>(bytes)) T(value);
    tag = List::template index_of<T>();
  }
};

namespace detail {

// A chain of comparisons with consecutive constants, which compilers fold into one switch.
template <class R, class F, class Storage, class T, class... Rest>
ETD_FN R dispatch_from(const Storage& s, F&& f, TypeList<T, Rest...>, uint32_t base = 0) {
  if (s.tag == base) return f(*std::launder(reinterpret_cast<const T*>(s.bytes)));
  if constexpr (sizeof...(Rest) == 0)
    __builtin_unreachable();
  else
    return dispatch_from<R>(s, std::forward<F>(f), TypeList<Rest...>{}, base + 1);
}

}  // namespace detail

// Calls f with the stored value as its own type. All branches return R.
template <class R, class List, class Storage, class F>
ETD_FN R dispatch(const Storage& storage, F&& f) {
  return detail::dispatch_from<R>(storage, std::forward<F>(f), List{});
}

}  // namespace etd
