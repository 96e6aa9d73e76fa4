#include "bsdfs/examples.h"

#include <vector>

#include "bsdfs/bsdf_list.h"

namespace etd {

namespace {

// Relative index of two metals near 630, 530 and 470 nm, rounded from the tables of Johnson and Christy (1972, copper)
// and Rakic (1995, aluminium).
struct Metal {
  const char* name;
  Spectrum eta, k;
};

template <class Top, class Bottom>
void add_layered(std::vector<BsdfExample>& list, const std::string& name, const Top& top, const Bottom& bottom,
                 const LayerSettings& layer) {
  list.push_back({"layered(" + name + ")", Bsdf(Layered<Top, Bottom>{top, bottom, layer})});
}

// Every pair of layers, and the media between them.
void add_layered(std::vector<BsdfExample>& list) {
  const LayerSettings clear{Spectrum(0.0f)};
  LayerSettings milky{Spectrum::rgb(0.9f, 0.6f, 0.3f), 0.5f, 0.4f}, two{Spectrum(0.0f), 0.05f, 0.0f, 3, 2};
  milky.max_depth = 20;
  const Lambert paint{Spectrum::rgb(0.8f, 0.5f, 0.2f)}, white{Spectrum(1.0f)};
  const Spectrum eta = Spectrum::rgb(0.14f, 0.69f, 0.77f), k = Spectrum::rgb(2.3f, 1.73f, 1.67f);  // copper under 1.5
  const SmoothDielectric varnish{1.5f};
  const RoughDielectric satin{1.5f, {0.3f, 0.3f}}, brushed{1.33f, {0.6f, 0.3f}}, rare{1 / 1.5f, {0.5f, 0.5f}};
  const RoughConductor rough{eta, k, {0.4f, 0.4f}};
  add_layered(list, "smooth on paint", varnish, paint, clear);
  add_layered(list, "smooth on white, milky", varnish, white, milky);
  add_layered(list, "rough on paint", satin, paint, clear);
  add_layered(list, "rough on white, two samples, depth 3", brushed, white, two);
  add_layered(list, "rough and of lower index on paint", rare, paint, clear);
  add_layered(list, "rough on paint, milky", satin, paint, milky);
  add_layered(list, "smooth on mirror", varnish, SmoothConductor{eta, k}, clear);
  add_layered(list, "smooth on mirror, milky", varnish, SmoothConductor{eta, k}, milky);
  add_layered(list, "smooth on rough metal", varnish, rough, clear);
  add_layered(list, "rough on mirror", satin, SmoothConductor{eta, k}, clear);
  add_layered(list, "rough on rough metal", satin, rough, milky);
}

// Closed forms of layers. The last ones have a coat of lower index than what is around, and of that of air.
void add_coated(std::vector<BsdfExample>& list) {
  const auto smooth = [&list](const char* name, float eta, float thickness, const Spectrum& paint, int32_t max_depth) {
    const SmoothCoat coat{{eta}, thickness, smooth_coat_means(eta, thickness)};
    list.push_back({std::string("coated_lambert(smooth, ") + name + ")", Bsdf(CoatedLambert(coat, paint, max_depth))});
  };
  const auto rough = [&list](const char* name, float eta, float alpha, float thickness, const Spectrum& paint,
                             int32_t max_depth) {
    static CoatTables tables;
    const RoughCoat coat{{eta, {alpha, alpha}}, tables.find(eta, alpha, thickness)};
    list.push_back({std::string("coated_lambert(rough, ") + name + ")", Bsdf(CoatedLambert(coat, paint, max_depth))});
  };
  const Spectrum paint = Spectrum::rgb(0.8f, 0.5f, 0.2f), white(1.0f), black(0.0f);
  smooth("1.5", 1.5f, 0.01f, paint, 10);
  smooth("1.5, white, no absorption", 1.5f, 1e-20f, white, 1000);
  list.back().lossless = true;
  smooth("1.5, black", 1.5f, 0.01f, black, 10);
  smooth("1/1.5, depth 2", 1.0f / 1.5f, 0.1f, paint, 2);
  smooth("1", 1.0f, 0.3f, paint, 3);
  rough("1.5, 0.3", 1.5f, 0.3f, 0.01f, paint, 10);
  rough("1.33, 0.05, white, depth 100", 1.33f, 0.05f, 0.3f, white, 100);
  rough("2, 1, depth 1", 2.0f, 1.0f, 1e-20f, paint, 1);
  rough("1.5, 0.2, black", 1.5f, 0.2f, 0.01f, black, 10);
  const SmoothConductor copper{Spectrum::rgb(0.14f, 0.69f, 0.77f), Spectrum::rgb(2.3f, 1.73f, 1.67f)};
  list.push_back({"coated_mirror(1.5)", Bsdf(CoatedMirror{{1.5f}, copper, 0.01f, 10})});
  list.push_back({"coated_mirror(1/1.5, depth 3)", Bsdf(CoatedMirror{{1.0f / 1.5f}, copper, 0.2f, 3})});
}

std::vector<BsdfExample> make_examples() {
  const Metal copper{"copper", Spectrum::rgb(0.21f, 1.04f, 1.15f), Spectrum::rgb(3.45f, 2.59f, 2.50f)};
  const Metal aluminium{"aluminium", Spectrum::rgb(1.41f, 0.91f, 0.69f), Spectrum::rgb(7.59f, 6.42f, 5.68f)};
  const Metal mirror{"mirror", Spectrum(0.0f), Spectrum(0.0f)};

  std::vector<BsdfExample> list{
      {"lambert(white)", Bsdf(Lambert{Spectrum(1.0f)}), true},
      {"lambert(0.5)", Bsdf(Lambert{Spectrum(0.5f)})},
      {"lambert(red)", Bsdf(Lambert{Spectrum::rgb(0.8f, 0.1f, 0.0f)})},
      {"lambert(black)", Bsdf(Lambert{Spectrum(0.0f)})},
      {"smooth_conductor(mirror)", Bsdf(SmoothConductor{mirror.eta, mirror.k}), true},
      {"smooth_conductor(copper)", Bsdf(SmoothConductor{copper.eta, copper.k})},
      {"smooth_conductor(aluminium)", Bsdf(SmoothConductor{aluminium.eta, aluminium.k})},
  };

  const auto rough = [&list](const Metal& m, const char* alpha, float ax, float ay, float min_cos = 0.0f) {
    const RoughConductor closure{m.eta, m.k, {ax, ay}};
    list.push_back({std::string("rough_conductor(") + m.name + ", " + alpha + ")", Bsdf(closure), false, min_cos});
  };
  rough(mirror, "0.5", 0.5f, 0.5f);
  rough(copper, "1", 1.0f, 1.0f);
  rough(copper, "0.5", 0.5f, 0.5f);
  rough(aluminium, "0.25", 0.25f, 0.25f);
  rough(aluminium, "0.1", 0.1f, 0.1f);
  rough(copper, "0.01", 0.01f, 0.01f);
  rough(copper, "0.001", 0.001f, 0.001f, 0.01f);
  rough(copper, "0.1 x 0.6", 0.1f, 0.6f);
  rough(aluminium, "1 x 0.05", 1.0f, 0.05f);
  rough(copper, "0.0001 x 0.3", 0.0001f, 0.3f, 0.01f);

  const auto glass = [&list](std::string name, float eta) {
    list.push_back({"smooth_dielectric(" + name + ")", Bsdf(SmoothDielectric{eta}), true});
  };
  glass("1.5", 1.5f);
  glass("1/1.5", 1.0f / 1.5f);
  glass("2.42", 2.42f);
  glass("1", 1.0f);

  const auto frosted = [&list](std::string name, float eta, float ax, float ay, float min_cos = 0.0f) {
    list.push_back({"rough_dielectric(" + name + ")", Bsdf(RoughDielectric{eta, {ax, ay}}), false, min_cos});
  };
  frosted("1.5, 1", 1.5f, 1.0f, 1.0f);
  frosted("1.5, 0.5", 1.5f, 0.5f, 0.5f);
  frosted("1/1.5, 0.5", 1.0f / 1.5f, 0.5f, 0.5f);
  frosted("1.5, 0.1", 1.5f, 0.1f, 0.1f);
  frosted("1/1.5, 0.1", 1.0f / 1.5f, 0.1f, 0.1f);
  frosted("1.5, 0.1 x 0.6", 1.5f, 0.1f, 0.6f);
  frosted("1.1, 0.3", 1.1f, 0.3f, 0.3f);
  frosted("2.42, 0.01", 2.42f, 0.01f, 0.01f, 0.01f);

  const auto compensated = [&list](std::string name, const auto& closure, const EnergyTable& table) {
    const EnergyCompensated<std::decay_t<decltype(closure)>> whole{closure, &table};
    list.push_back({"energy_compensated(" + name + ")", Bsdf(whole)});
  };
  compensated("rough copper, 0.7", RoughConductor{copper.eta, copper.k, {0.7f, 0.7f}}, mirror_energy());
  compensated("rough copper, 0.1 x 0.6", RoughConductor{copper.eta, copper.k, {0.1f, 0.6f}}, mirror_energy());
  compensated("rough glass, 1.5, 0.5", RoughDielectric{1.5f, {0.5f, 0.5f}}, dielectric_energy(1.5f));
  compensated("rough glass, 1/1.5, 0.3", RoughDielectric{1.0f / 1.5f, {0.3f, 0.3f}}, dielectric_energy(1.0f / 1.5f));

  list.push_back({"thin_dielectric(1.5)", Bsdf(ThinDielectric{1.5f}), true});
  list.push_back({"thin_dielectric(1/1.5)", Bsdf(ThinDielectric{1.0f / 1.5f}), true});
  list.push_back({"thin_dielectric(1)", Bsdf(ThinDielectric{1.0f}), true});

  const auto sheet = [&list](std::string name, const Spectrum& r, const Spectrum& t, bool lossless = false) {
    list.push_back({"diffuse_transmission(" + name + ")", Bsdf(DiffuseTransmission{r, t}), lossless});
  };
  sheet("0.25, 0.75", Spectrum(0.25f), Spectrum(0.75f), true);
  sheet("red, green", Spectrum::rgb(0.6f, 0.1f, 0.0f), Spectrum::rgb(0.1f, 0.5f, 0.2f));
  sheet("0, 0.5", Spectrum(0.0f), Spectrum(0.5f));
  sheet("black", Spectrum(0.0f), Spectrum(0.0f));
  add_layered(list);
  add_coated(list);
  return list;
}

}  // namespace

std::span<const BsdfExample> bsdf_examples() {
  static const std::vector<BsdfExample> examples = make_examples();
  return examples;
}

}  // namespace etd
