// The list of filters and their dispatch. To add one: its header, its name in the lists, its constructor line.
#include "filters/filter.h"

#include "filters/box.h"
#include "filters/gaussian.h"
#include "filters/mitchell.h"
#include "filters/sinc.h"
#include "filters/triangle.h"

namespace etd {

namespace {
using Filters = TypeList<BoxFilter, GaussianFilter, MitchellFilter, SincFilter, TriangleFilter>;
}  // namespace

template <class T>
Filter::Filter(const T& filter) {
  storage_.store<Filters>(filter);
}
template Filter::Filter(const BoxFilter&);
template Filter::Filter(const GaussianFilter&);
template Filter::Filter(const MitchellFilter&);
template Filter::Filter(const SincFilter&);
template Filter::Filter(const TriangleFilter&);

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
  static const ModelDecl* const all[] = {&BoxFilter::decl(), &GaussianFilter::decl(), &MitchellFilter::decl(),
                                         &SincFilter::decl(), &TriangleFilter::decl()};
  return all;
}

Filter make_filter(const ModelUse& use, Diagnostics& diagnostics) {
  if (use.model == "box") return Filter(BoxFilter::create({BoxFilter::decl(), use, diagnostics}));
  if (use.model == "mitchell") return Filter(MitchellFilter::create({MitchellFilter::decl(), use, diagnostics}));
  if (use.model == "sinc") return Filter(SincFilter::create({SincFilter::decl(), use, diagnostics}));
  if (use.model == "triangle") return Filter(TriangleFilter::create({TriangleFilter::decl(), use, diagnostics}));
  return Filter(GaussianFilter::create({GaussianFilter::decl(), use, diagnostics}));
}

}  // namespace etd
