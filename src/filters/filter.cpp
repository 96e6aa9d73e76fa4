#include "filters/filter.h"

#include "filters/filter_list.h"
#include "params/model_list.h"

namespace etd {

FilterSample Filter::sample(Vec2 u) const {
  return dispatch<FilterSample, Filters>(storage_, [&](const auto& f) { return f.sample(u); });
}

float Filter::eval(Vec2 offset) const {
  return dispatch<float, Filters>(storage_, [&](const auto& f) { return f.eval(offset); });
}

Vec2 Filter::radius() const {
  return dispatch<Vec2, Filters>(storage_, [](const auto& f) { return f.radius(); });
}

std::span<const ModelDecl* const> filter_models() {
  static const std::vector<const ModelDecl*> all = declarations(Filters{});
  return all;
}

Filter make_filter(const ModelUse& use, Diagnostics& diagnostics) {
  Filter filter;
  const auto make = [&]<class T>(std::type_identity<T>, const ParamReader& p) { filter = Filter(T::create(p)); };
  if (!with_model(Filters{}, use, diagnostics, make))
    make(std::type_identity<GaussianFilter>(), {GaussianFilter::decl(), use, diagnostics});
  return filter;
}

}  // namespace etd
