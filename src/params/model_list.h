// What the list of a family's types tells beside its dispatch (core/tagged.h): the declarations of its models, and
// which of them a scene means. A type T of the list has T::decl(). Types may share a declaration, as an infinite light
// and one with an image do; each of them but the last then says with T::is_meant(params) whether it is the one. Types
// without parameters of their own, which a parameter of other models names, have T::kName and T::kDoc instead.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
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

template <class T>
std::string_view name_of() {
  if constexpr (requires { T::kName; })
    return T::kName;
  else
    return T::decl().name;
}

// Calls f(std::type_identity<T>()) for the type of that name, and returns whether there is one.
template <class... Ts, class F>
bool with_named(TypeList<Ts...>, std::string_view name, F&& f) {
  return ((name == name_of<Ts>() ? (f(std::type_identity<Ts>()), true) : false) || ...);
}

// The parameter that names one of the types. Its sentence is `before`, what the types say of themselves, and `behind`.
template <class Default, class... Ts>
ParamDecl choice_param(TypeList<Ts...>, std::string name, const std::string& before, const std::string& behind) {
  ParamDecl p{.name = std::move(name),
              .type = ParamType::kString,
              .default_value = std::string(Default::kName),
              .choices = {Ts::kName...},
              .doc = before};
  const std::vector<std::string> docs{Ts::kDoc...};
  for (size_t i = 0; i < docs.size(); ++i) p.doc += (i == 0 ? "" : i + 1 == docs.size() ? ", or " : ", ") + docs[i];
  p.doc += behind;
  return p;
}

}  // namespace etd
