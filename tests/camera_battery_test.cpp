// The battery over cameras catches mistakes, each by the check that is there for it. (CameraBattery.Passes, in
// battery_test.cpp: without mistakes all cameras pass.)
#include <gtest/gtest.h>

#include <set>

#include "core/hash.h"
#include "slow_build.h"
#include "verify/battery/camera/model.h"

namespace etd {
namespace {

CameraModel model(const std::string& name) {
  for (const CameraSetting& setting : camera_settings())
    if (setting.name == name) return camera_model(setting).model;
  ADD_FAILURE() << "no setting " << name;
  return {};
}

const char* const kPinhole = "perspective";
const char* const kParallel = "orthographic";
const char* const kSphere = "spherical(mapping equirectangular, shutteropen 0, shutterclose 1)";
const char* const kMoving = "perspective(moving)";
const char* const kStar = "perspective(lensradius 0.4, focaldistance 2.5, aperture star)";
const char* const kGaussian = "perspective(lensradius 0.4, focaldistance 2.5, aperture gaussian)";
const char* const kParallelLens = "orthographic(lensradius 0.4, focaldistance 2.5, aperture pentagon)";
const char* const kStretched = "orthographic(lensradius 0.4, focaldistance 2.5, blades 3, bladerotation 20), stretched";
const char* const kMirrored = "perspective(screenwindow 0.75 -0.5 -0.25 0.75)";

// In half of 10^6 runs none of a model's checks fails without a fault.
std::set<std::string> failures(const CameraModel& m) {
  std::set<std::string> names;
  for (const CheckResult& r : check_camera(m, {kSlowBuild ? 0.2 : 0.4, 1, 1e-6}))
    if (!r.passed) names.insert(r.name);
  return names;
}

void expect_caught(const CameraModel& m, const std::string& check, const std::string& what) {
  const std::set<std::string> found = failures(m);
  std::string text;
  for (const std::string& name : found) text += name + "; ";
  EXPECT_TRUE(found.count(check)) << m.name << ", " << what << ": caught by " << text;
}

using ChangeRay = std::function<void(Ray&)>;
CameraModel with_rays(CameraModel m, const ChangeRay& change) {
  m.generate_ray = [make = m.generate_ray, change](const CameraSample& s) {
    Ray ray = make(s);
    change(ray);
    return ray;
  };
  return m;
}

TEST(CameraBatteryFaults, RaysNotOfUnitLengthOrNotFinite) {
  for (const float factor : {1.0001f, kInfinity})
    expect_caught(with_rays(model(kPinhole), [=](Ray& r) { r.d = r.d * factor; }), "finite, unit directions", "longer");
}

TEST(CameraBatteryFaults, RaysThatRememberEarlierOnes) {
  int calls = 0;
  expect_caught(with_rays(model(kPinhole), [&](Ray& r) { r.o.x += ++calls == 101 ? 1e-6f : 0.0f; }),
                "the same for the same sample", "one call of many");
}

// Rays bent in one direction of the lens meet before those of the other: an astigmatism.
TEST(CameraBatteryFaults, RaysOfAFilmPointThatDoNotMeet) {
  for (const char* name : {kStar, kParallelLens}) {
    const CameraModel m = model(name);
    expect_caught(with_rays(m, [&](Ray& r) { r.d = normalize(r.d - m.up * (0.1f * dot(r.o - m.eye, m.up))); }),
                  "rays of a film point meet", "astigmatism");
  }
}

TEST(CameraBatteryFaults, FilmNotSpreadAsPromised) {
  for (const char* name : {kPinhole, kParallel, kSphere, "spherical", kMirrored}) {
    CameraModel m = model(name);
    m.generate_ray = [make = m.generate_ray](CameraSample s) {
      const float x = s.film.x / CameraModel::kFilmWidth;
      s.film.x = CameraModel::kFilmWidth * (x + 0.02f * x * (1 - x));
      return make(s);
    };
    expect_caught(m, "film to directions and area", "stretched on one side");
  }
}

// Changes we() and sample_wi() alike, so that they agree with each other.
using ChangeImportance = std::function<void(CameraImportance&)>;
CameraModel with_importance(CameraModel m, const ChangeImportance& change) {
  m.we = [we = m.we, change](const Ray& ray, float margin) {
    auto i = we(ray, margin);
    if (i) change(*i);
    return i;
  };
  m.sample_wi = [sample = m.sample_wi, change, parallel = m.spread == FilmSpread::kParallel](Point3 p, Vec2 u,
                                                                                             float time, float margin) {
    auto c = sample(p, u, time, margin);
    if (!c) return c;
    change(c->importance);
    const CameraImportance& i = c->importance;
    if (parallel) {
      c->weight = i.pdf_position / i.cosine;
      if (!c->is_delta) c->pdf = i.pdf_direction;
    } else {
      c->weight = i.pdf_direction / sqr(c->distance);
      if (!c->is_delta) c->pdf = i.pdf_position * sqr(c->distance) / i.cosine;
    }
    return c;
  };
  return m;
}

TEST(CameraBatteryFaults, ImportanceWithACosineTooFew) {
  const auto without = [](const char* name) {
    return with_importance(model(name), [](CameraImportance& i) { i.cosine = 1; });
  };
  for (const char* name : {kStar, kGaussian}) expect_caught(without(name), "we = rays", "cos^3");
  for (const char* name : {kStar, kParallelLens, kMoving})
    expect_caught(without(name), "importance = density", "cos^3");
  for (const char* name : {kPinhole, kMirrored}) {
    const CameraModel m = with_importance(model(name), [](CameraImportance& i) { i.pdf_direction *= i.cosine; });
    expect_caught(m, "sample_wi = rays", "cos^2 in the density");
    expect_caught(m, "importance = density", "cos^2 in the density");
  }
}

TEST(CameraBatteryFaults, ImportanceWithoutAreaOfTheLens) {
  for (const char* name : {kStar, kGaussian})
    expect_caught(with_importance(model(name), [](CameraImportance& i) { i.pdf_position *= 0.16f; }), "we = rays",
                  "area of the unit lens");
  expect_caught(with_importance(model(kParallelLens), [](CameraImportance& i) { i.pdf_direction *= 0.16f; }),
                "we = rays", "area of the unit lens");
  expect_caught(with_importance(model(kPinhole), [](CameraImportance& i) { i.pdf_position *= 0.16f; }),
                "importance = density", "a pinhole with area");
}

// An opening's density that is the same everywhere.
TEST(CameraBatteryFaults, ImportanceWithoutTheOpeningsShape) {
  expect_caught(with_importance(model(kGaussian), [](CameraImportance& i) { i.pdf_position = 1 / (kPi * 0.16f); }),
                "we = rays", "uniform");
}

TEST(CameraBatteryFaults, DensityTwoPercentOff) {
  for (const char* name : {kPinhole, kStar, kSphere, "spherical", kMoving, "spherical(stretched)"})
    expect_caught(with_importance(model(name), [](CameraImportance& i) { i.pdf_direction *= 1.02f; }),
                  "importance = density", "2 %");
  for (const char* name : {kParallel, kParallelLens, kStretched})
    expect_caught(with_importance(model(name), [](CameraImportance& i) { i.pdf_position *= 1.02f; }),
                  "importance = density", "2 %");
}

TEST(CameraBatteryFaults, FilmMirrored) {
  for (const char* name : {kPinhole, kParallel, kSphere, "spherical", kStar}) {
    const CameraModel m = with_importance(
        model(name), [](CameraImportance& i) { i.film.x = next_down(CameraModel::kFilmWidth - i.film.x); });
    expect_caught(m, "rays tell their film point", "mirrored");
    expect_caught(m, "sample_wi = rays", "mirrored");
  }
}

TEST(CameraBatteryFaults, WeightOfConnections) {
  const auto with_weight = [](CameraModel m, std::function<float(const CameraConnection&)> factor) {
    m.sample_wi = [sample = m.sample_wi, factor](Point3 p, Vec2 u, float time, float margin) {
      auto c = sample(p, u, time, margin);
      if (c) c->weight *= factor(*c);
      return c;
    };
    return m;
  };
  for (const char* name : {kPinhole, kParallel, "spherical", kStar, kParallelLens}) {
    const CameraModel m = with_weight(model(name), [](const CameraConnection& c) { return 0.1f * c.distance; });
    expect_caught(m, "sample_wi = we", "1 / d");
    expect_caught(m, "sample_wi = rays", "1 / d");
  }
  expect_caught(with_weight(model(kStar), [](const CameraConnection& c) { return c.importance.cosine; }),
                "sample_wi = rays", "cosine twice");
}

// The whole of space through the pinhole, upside down behind it.
TEST(CameraBatteryFaults, PointsBehindTheCamera) {
  CameraModel m = model(kPinhole);
  m.sample_wi = [sample = m.sample_wi, eye = m.eye](Point3 p, Vec2 u, float time, float margin) {
    const auto c = sample(p, u, time, margin);
    if (c) return c;
    auto behind = sample(eye - (p - eye), u, time, margin);
    if (behind) behind->wi = -behind->wi;
    return behind;
  };
  expect_caught(m, "no importance elsewhere", "behind");
  expect_caught(m, "sample_wi = rays", "behind");
}

TEST(CameraBatteryFaults, BeyondTheFilmOrBesideTheLens) {
  for (const char* name : {kPinhole, kParallel, kParallelLens}) {
    CameraModel m = model(name);
    m.we = [we = m.we](const Ray& ray, float) { return we(ray, 100); };
    expect_caught(m, "no importance elsewhere", "beyond the film");
  }
  for (const char* name : {kPinhole, kSphere}) {
    CameraModel m = model(name);
    m.we = [we = m.we, eye = m.eye](const Ray& ray, float margin) { return we({eye, ray.d}, margin); };
    expect_caught(m, "no importance elsewhere", "beside the pinhole");
  }
}

TEST(CameraBatteryFaults, PartOfTheLensLost) {
  CameraModel m = model(kStar);
  m.sample_wi = [sample = m.sample_wi](Point3 p, Vec2 u, float time, float margin) {
    return u.x < 0.1f ? std::nullopt : sample(p, u, time, margin);
  };
  expect_caught(m, "sample_wi = rays", "a tenth");
  m = model(kStar);
  m.we = [we = m.we, eye = m.eye, up = m.up](const Ray& ray, float margin) {
    return dot(ray.o - eye, up) > 0.1f ? std::nullopt : we(ray, margin);
  };
  expect_caught(m, "we = rays", "the upper part");
}

TEST(CameraBatteryFaults, AtAnotherTime) {
  for (const char* name : {kMoving, "orthographic(moving)", "spherical(moving)"}) {
    CameraModel m = model(name);
    m.we = [we = m.we](Ray ray, float margin) {
      ray.time = 0.5f;
      return we(ray, margin);
    };
    expect_caught(m, "rays tell their film point", "we");
    m = model(name);
    m.sample_wi = [sample = m.sample_wi](Point3 p, Vec2 u, float, float margin) { return sample(p, u, 0.5f, margin); };
    expect_caught(m, "sample_wi = we", "sample_wi");
  }
}

// None of 20 seeds fails, and 960 p-values have a smallest of 0.002.
TEST(SlowCameraBattery, NoFalseAlarmInTwentySeeds) {
  for (uint64_t seed = 1; seed <= 20; ++seed)
    for (const CameraSetting& setting : camera_settings())
      for (const CheckResult& r : check_camera(camera_model(setting).model, {0.4, seed, 1e-4 / 400}))
        EXPECT_TRUE(r.passed) << "seed " << seed << ": " << to_string(r);
}

}  // namespace
}  // namespace etd
