// What the list of a family's types tells beside its dispatch (core/tagged.h): the declarations of its models, and
// which of them a scene means. A type T of the list has T::decl(). Types may share a declaration, as an infinite light
// and one with an image do; each of them but the last then says with T::is_meant(params) whether it is the one.
#pragma once

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/tagged.h"
#include "params/declaration.h"

namespace etd {

// The declarations in the order of the list, each once.
template <class... Ts>
std::vector<const ModelDecl*> declarations(TypeList<Ts...>) {
  std::vector<const ModelDecl*> all;
  for (const ModelDecl* decl : {&Ts::decl()...})
    if (std::find(all.begin(), all.end(), decl) == all.end()) all.push_back(decl);
  return all;
}

// Calls f(std::type_identity<T>(), params) for the type that a checked use means, and returns whether there is one.
template <class... Ts, class F>
bool with_model(TypeList<Ts...>, const ModelUse& use, Diagnostics& diagnostics, F&& f) {
  const auto takes = [&]<class T>(std::type_identity<T> type) {
    if (use.model != T::decl().name) return false;
    const ParamReader params(T::decl(), use, diagnostics);
    if constexpr (requires { T::is_meant(params); })
      if (!T::is_meant(params)) return false;
    f(type, params);
    return true;
  };
  return (takes(std::type_identity<Ts>()) || ...);
}

}  // namespace etd
