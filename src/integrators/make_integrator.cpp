#include "integrators/make_integrator.h"

#include <array>
#include <vector>

#include "integrators/light.h"
#include "integrators/path.h"
#include "integrators/sppm.h"

namespace etd {

namespace {

// What the list knows of an integrator: a class T has T::decl(), T::kTraits, T::create() and T::variants().
struct Entry {
  const ModelDecl* decl;
  IntegratorTraits traits;
  std::unique_ptr<Integrator> (*create)(const ParamReader& p, const Scene& scene, const IntegratorContext& context);
  std::vector<Variant> (*variants)(const Scene& scene, int max_depth);
};

template <class... Ts>
struct EntriesOf {
  static std::array<Entry, sizeof...(Ts)> make() {
    return {Entry{&Ts::decl(), Ts::kTraits, &Ts::create, &Ts::variants}...};
  }
};

// The first is the default.
using Integrators = EntriesOf<PathIntegrator, LightIntegrator, SppmIntegrator>;

const auto& entries() {
  static const auto all = Integrators::make();
  return all;
}

const Entry& entry(std::string_view name) {
  for (const Entry& e : entries())
    if (e.decl->name == name) return e;
  return entries().front();
}

}  // namespace

std::span<const ModelDecl* const> integrator_models() {
  static const auto all = [] {
    std::vector<const ModelDecl*> decls;
    for (const Entry& e : entries()) decls.push_back(e.decl);
    return decls;
  }();
  return all;
}

const IntegratorTraits& integrator_traits(std::string_view name) { return entry(name).traits; }

std::vector<Variant> integrator_variants(const Scene& scene, int max_depth) {
  std::vector<Variant> all;
  for (const Entry& e : entries())
    for (Variant& v : e.variants(scene, max_depth)) {
      v.integrator = e.decl->name;
      all.push_back(std::move(v));
    }
  return all;
}

std::unique_ptr<Integrator> make_integrator(const ModelUse& use, const Scene& scene, const IntegratorContext& context,
                                            Diagnostics& diagnostics) {
  const Entry& e = entry(use.model);
  return e.create({*e.decl, use, diagnostics}, scene, context);
}

}  // namespace etd
