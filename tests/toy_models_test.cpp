// A model is one file and one line. The file of each toy below would hold nothing else, and the line is its name in the
// list of its family: with lists that are one type longer, everything that families do with their lists works for the
// toys as well.
#include <gtest/gtest.h>

#include "bsdfs/bsdf_list.h"
#include "cameras/camera_list.h"
#include "film/film_list.h"
#include "filters/filter_list.h"
#include "light_sampling/light_sampler_list.h"
#include "lights/light_list.h"
#include "materials/material_list.h"
#include "params/model_list.h"
#include "samplers/sampler_list.h"
#include "shapes/shape_list.h"
#include "textures/texture_list.h"

namespace etd {
namespace {

template <class List, class Toy>
struct Longer;
template <class... Ts, class Toy>
struct Longer<TypeList<Ts...>, Toy> {
  using Type = TypeList<Ts..., Toy>;
};
template <class List, class Toy>
using WithToy = typename Longer<List, Toy>::Type;

// A declaration with one parameter.
const ModelDecl& toy_decl(Family family) {
  static std::map<Family, ModelDecl> all;
  return all
      .try_emplace(family, ModelDecl{family, "toy", "A toy.", {{.name = "size", .default_value = 1.0, .doc = "Size."}}})
      .first->second;
}

ModelUse toy_use() {
  Param size;
  size.name = "size";
  size.numbers = {0.25};
  return {"toy", {size}, {}};
}

// Makes the toy that a scene asks for by its name, and leaves all other types of the list alone.
template <class List, class Toy, class Make>
Toy made(Make&& make) {
  const std::vector<const ModelDecl*> before = declarations(List{}), after = declarations(WithToy<List, Toy>{});
  EXPECT_EQ(after.size(), before.size() + 1);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
  EXPECT_EQ(after.back()->name, "toy");
  Diagnostics diagnostics;
  const ModelUse use = toy_use();
  check_params(*after.back(), use, diagnostics);
  std::optional<Toy> toy;
  EXPECT_FALSE(with_model(List{}, use, diagnostics, [](auto, const ParamReader&) {}));
  EXPECT_TRUE(
      with_model(WithToy<List, Toy>{}, use, diagnostics, [&]<class T>(std::type_identity<T>, const ParamReader& p) {
        if constexpr (std::is_same_v<T, Toy>)
          toy.emplace(make(p));
        else
          ADD_FAILURE() << T::decl().name;
      }));
  EXPECT_FALSE(diagnostics.has_errors());
  return *toy;
}

// Calls f with the value that a buffer of the family holds, whatever type of the list it is.
template <class R, class List, class Toy, class F>
R dispatched(const Toy& toy, F&& f) {
  TaggedStorage<2048> storage;
  storage.store<WithToy<List, Toy>>(toy);
  return dispatch<R, WithToy<List, Toy>>(storage, f);
}

struct ToyFilter {
  float size;
  static const ModelDecl& decl() { return toy_decl(Family::kFilter); }
  static ToyFilter create(const ParamReader& p) { return {static_cast<float>(p.number("size"))}; }
  FilterSample sample(Vec2 u) const { return {{(u.x - 0.5f) * size, (u.y - 0.5f) * size}, 1.0f}; }
  float eval(Vec2) const { return 1.0f / sqr(size); }
  Vec2 radius() const { return {size / 2, size / 2}; }
};

TEST(ToyModels, Filter) {
  const auto toy = made<Filters, ToyFilter>([](const ParamReader& p) { return ToyFilter::create(p); });
  EXPECT_EQ((dispatched<float, Filters>(toy, [](const auto& f) { return f.eval({}); })), 16.0f);
  EXPECT_EQ((dispatched<FilterSample, Filters>(toy, [](const auto& f) { return f.sample({1, 0}); })).offset.x, 0.125f);
}

struct ToyCamera {
  float size;
  static const ModelDecl& decl() { return toy_decl(Family::kCamera); }
  static ToyCamera create(const ParamReader& p, const CameraFrame&, CameraData&) {
    return {static_cast<float>(p.number("size"))};
  }
  Ray generate_ray(const CameraSample& s) const { return {{s.film.x * size, 0, 0}, {0, 0, 1}}; }
  std::optional<CameraImportance> we(Point3, Vec3) const { return {}; }
  std::optional<CameraConnection> sample_wi(Point3, Vec2) const { return {}; }
  void move(const Transform&) {}
};

TEST(ToyModels, Camera) {
  CameraData data;
  const auto toy =
      made<Cameras, ToyCamera>([&](const ParamReader& p) { return ToyCamera::create(p, CameraFrame(), data); });
  const CameraSample at{{8, 0}, {}};
  EXPECT_EQ((dispatched<Ray, Cameras>(toy, [&](const auto& c) { return c.generate_ray(at); })).o.x, 2.0f);
}

struct ToyTexture {
  float size;
  static const ModelDecl& decl() { return toy_decl(Family::kTexture); }
  static ToyTexture create(const ParamReader& p, TextureBuilder&) { return {static_cast<float>(p.number("size"))}; }
  Spectrum eval(const TexCoord& at, const TextureTable&, const ShadingContext& context) const {
    return Spectrum(at.uv.x * size + context.time);
  }
};

TEST(ToyModels, Texture) {
  TextureTable table;
  TextureBuilder builder(table, {});
  const auto toy = made<Textures, ToyTexture>([&](const ParamReader& p) { return ToyTexture::create(p, builder); });
  const auto eval = [&](const auto& t) { return t.eval({{2, 0}}, table, {.time = 0.5f}); };
  EXPECT_EQ((dispatched<Spectrum, Textures>(toy, eval))[0], 1.0f);
}

// Scatters straight through.
struct ToyClosure {
  static constexpr BsdfTraits kTraits{.delta = true};
  Spectrum eval_cos(Vec3, Vec3, TransportMode, HashStream&) const { return Spectrum(); }
  float pdf(Vec3, Vec3, TransportMode, Lobe) const { return 0.0f; }
  std::optional<BsdfSample> sample(Vec3 wo, Vec3, TransportMode, HashStream&, Lobe) const {
    return BsdfSample{-wo, Spectrum(1.0f), 1.0f, kTransmission | kDelta};
  }
  Lobe lobes() const { return kTransmission | kDelta; }
  float widest_alpha() const { return 0.0f; }
  Spectrum albedo(Vec3) const { return Spectrum(1.0f); }
};

TEST(ToyModels, Closure) {
  HashStream rng(1);
  const auto sample = [&](const auto& c) { return c.sample({0, 0, 1}, {}, TransportMode::kRadiance, rng, kBothSides); };
  const auto s = dispatched<std::optional<BsdfSample>, Closures>(ToyClosure(), sample);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->wi.z, -1.0f);
  EXPECT_TRUE((dispatched<BsdfTraits, Closures>(ToyClosure(), [](const auto& c) { return c.kTraits; })).delta);
}

struct ToyMaterial {
  float size;
  static const ModelDecl& decl() { return toy_decl(Family::kMaterial); }
  static ToyMaterial create(const ParamReader& p, TextureBuilder&) { return {static_cast<float>(p.number("size"))}; }
  Bsdf closure(const TexCoord&, const TextureTable&, const ShadingContext&) const {
    return Bsdf(Lambert{Spectrum(size)});
  }
};

TEST(ToyModels, Material) {
  TextureTable table;
  TextureBuilder builder(table, {});
  const auto toy = made<Materials, ToyMaterial>([&](const ParamReader& p) { return ToyMaterial::create(p, builder); });
  const Bsdf closure = dispatched<Bsdf, Materials>(toy, [&](const auto& m) { return m.closure({}, table, {}); });
  EXPECT_EQ(closure.albedo({0, 0, 1})[0], 0.25f);
  EXPECT_TRUE(closure.has_smooth_lobe());
}

// Shines from above, the same everywhere.
struct ToyLight {
  float size;
  static const ModelDecl& decl() { return toy_decl(Family::kLight); }
  static std::optional<ToyLight> create(const ParamReader& p, const LightContext&) {
    return ToyLight{static_cast<float>(p.number("size"))};
  }
  bool is_infinite() const { return true; }
  bool is_delta() const { return true; }
  std::optional<LightSample> sample_li(Point3, Vec2, const ShadingContext& context, LightSampling) const {
    return LightSample{{0, 0, 1}, Spectrum(size * context.time), 1.0f, {}, true};
  }
  float pdf_li(Point3, Vec3, const SurfacePoint*, const ShadingContext&, LightSampling) const { return 0.0f; }
  Spectrum emitted(const SurfacePoint*, Vec3, const ShadingContext&, Point3) const { return Spectrum(); }
  Spectrum power() const { return Spectrum(size); }
};

TEST(ToyModels, Light) {
  LightData data;
  const LightContext context{Transform(), {}, data};
  const auto toy = made<StandingLights, ToyLight>([&](const ParamReader& p) { return *ToyLight::create(p, context); });
  const auto sample = [](const auto& l) { return l.sample_li({}, {}, {.time = 0.5f}, LightSampling::kComplete); };
  const auto s = dispatched<std::optional<LightSample>, Lights>(toy, sample);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->radiance[0], 0.125f);
}

// Its power is all that tells it from the toy light.
template <class Surface>
struct ToyLightOnSurface : ToyLight {
  float area;
  Spectrum power() const { return Spectrum(size * area); }
};

struct ToyAreaLight {
  template <class Surface>
  using On = ToyLightOnSurface<Surface>;
  static const ModelDecl& decl() { return toy_decl(Family::kAreaLight); }
  template <class Keep>
  static void create(const ParamReader& p, const AreaLightContext& context, Keep&& keep) {
    const auto size = static_cast<float>(p.number("size"));
    context.surfaces.with_all([&](const auto&... kinds) {
      const auto add = [&]<class Surface>(const std::vector<Surface>& surfaces) {
        for (const Surface& s : surfaces) keep(On<Surface>{{size}, s.area()});
      };
      (add(kinds), ...);
    });
  }
};

TEST(ToyModels, AreaLight) {
  using Longer = LightsOf<WithToy<AreaLightModels, ToyAreaLight>>::Type;
  EXPECT_EQ(Longer::kCount, Lights::kCount + 4);
  PatchMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}};
  mesh.patches = {{0, 1, 2, 3}};
  const ShapeSurfaces surfaces{.patches = {PatchSurface(mesh, 0)}};
  LightData data;
  Spectrum power;
  made<AreaLightModels, ToyAreaLight>([&](const ParamReader& p) {
    ToyAreaLight::create(p, {surfaces, {}, data}, [&](const auto& light) {
      TaggedStorage<2048> storage;
      storage.store<Longer>(light);
      power += dispatch<Spectrum, Longer>(storage, [](const auto& l) { return l.power(); });
    });
    return ToyAreaLight();
  });
  EXPECT_FLOAT_EQ(power[0], 0.5f);
}

// It chooses all lights alike, but the first for receivers behind a plane.
struct ToyLightSampler {
  static constexpr const char* kName = "toy";
  static constexpr const char* kDoc = "by chance";
  uint32_t count;
  static ToyLightSampler create(const LightSamplerContext& context, LightSamplerData&) {
    return {static_cast<uint32_t>(context.lights.size())};
  }
  std::optional<LightChoice> choose(double u, const LightReceiver* receiver) const {
    const uint32_t light = receiver && receiver->p.z < 0 ? 0 : static_cast<uint32_t>(u * count);
    return LightChoice{light, probability(light, receiver)};
  }
  float probability(uint32_t light, const LightReceiver* receiver) const {
    if (receiver && receiver->p.z < 0) return light == 0 ? 1.0f : 0.0f;
    return 1.0f / static_cast<float>(count);
  }
};

TEST(ToyModels, LightSampler) {
  const ParamDecl before = light_sampler_param();
  using Longer = WithToy<LightSamplers, ToyLightSampler>;
  const ParamDecl after = choice_param<PowerLightSampler>(Longer{}, before.name, "Chosen ", ".");
  EXPECT_EQ(after.choices, (std::vector<std::string>{"bvh", "power", "uniform", "toy"}));
  EXPECT_EQ(after.doc,
            "Chosen by a tree of their bounds, by their power, all alike, or by "
            "chance.");
  EXPECT_FALSE(with_named(LightSamplers{}, "toy", [](auto) {}));
  const std::vector<Light> lights(4, Light(ConstantInfiniteLight{Spectrum(1.0f)}));
  LightSamplerData data;
  std::optional<ToyLightSampler> toy;
  EXPECT_TRUE(with_named(Longer{}, "toy", [&]<class T>(std::type_identity<T>) {
    if constexpr (std::is_same_v<T, ToyLightSampler>) toy = T::create({lights}, data);
  }));
  ASSERT_TRUE(toy);
  SurfacePoint behind;
  behind.p = {0, 0, -1};
  const LightReceiver receiver(behind, 0.0f);
  const auto choice = [&](const LightReceiver* r) {
    return *dispatched<std::optional<LightChoice>, LightSamplers>(*toy,
                                                                  [&](const auto& s) { return s.choose(0.8, r); });
  };
  EXPECT_EQ(choice(nullptr).light, 3u);
  EXPECT_EQ(choice(nullptr).probability, 0.25f);
  EXPECT_EQ(choice(&receiver).light, 0u);
  EXPECT_EQ(choice(&receiver).probability, 1.0f);
}

// Its digits are half of the sample's index, and the dimension.
struct ToySampler {
  static constexpr SamplerTraits kTraits{};
  static const ModelDecl& decl() { return toy_decl(Family::kSampler); }
  static Digits digits(const SampleNumber& n) { return {n.index / 2, n.dimension}; }
};

TEST(ToyModels, Sampler) {
  const auto toy = made<Samplers, ToySampler>([](const ParamReader&) { return ToySampler(); });
  const SampleNumber number{1, 6, 2};
  const auto digits = dispatched<Digits, Samplers>(toy, [&](const auto& s) { return s.digits(number); });
  EXPECT_EQ(digits.x, 3u);
  EXPECT_EQ(digits.y, 2u);
  EXPECT_FALSE((dispatched<SamplerTraits, Samplers>(toy, [](const auto& s) { return s.kTraits; }).stratified));
}

struct ToyFilm {
  static const ModelDecl& decl() {
    static const ModelDecl d =
        with_params({Family::kFilm, "toy", "A toy.", {}}, {RgbFilm::decl().params, toy_decl(Family::kFilm).params});
    return d;
  }
  static FilmModel create(const ParamReader& p, const FilmContext& context) {
    FilmModel model = RgbFilm::create(p, context);
    model.settings.sensor.imaging_ratio *= p.number("size");
    return model;
  }
};

TEST(ToyModels, Film) {
  FilmModel model;
  made<Films, ToyFilm>([&](const ParamReader& p) {
    model = ToyFilm::create(p, {.size = std::pair(8, 4)});
    return ToyFilm();
  });
  EXPECT_EQ(model.settings.width, 8);
  EXPECT_EQ(model.settings.sensor.imaging_ratio, 0.25);
}

struct ToyShape {
  static const ModelDecl& decl() { return toy_decl(Family::kShape); }
  static ShapeGeometry create(const ParamReader& p, const ShapeContext&) {
    const double size = p.number("size");
    return {.quadric = QuadricShape{Transform::scale({size, size, size}), {}}};
  }
};

TEST(ToyModels, Shape) {
  MeshFiles files;
  ShapeGeometry geometry;
  made<Shapes, ToyShape>([&](const ParamReader& p) {
    geometry = ToyShape::create(p, {{}, files});
    return ToyShape();
  });
  ASSERT_TRUE(geometry.quadric);
  EXPECT_EQ(geometry.quadric->unit_to_object.vector({1, 0, 0}).x, 0.25);
}

}  // namespace
}  // namespace etd
