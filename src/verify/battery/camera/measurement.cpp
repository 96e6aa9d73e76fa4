// The importance of cameras against their rays, all together: light measured in both ways.
#include <fmt/format.h>

#include <array>

#include "core/frame.h"
#include "core/warp.h"
#include "verify/battery/camera/checks.h"

namespace etd {

namespace {

constexpr int kWidth = CameraModel::kFilmWidth, kHeight = CameraModel::kFilmHeight;

// Radiance on a sphere around the camera and points to see it from, by chance.
class Surroundings {
 public:
  static constexpr float kRadius = 12.0f, kAnywhere = 0.125f;

  explicit Surroundings(const CameraModel& m) : centre_(m.eye), frame_(Frame::from_z(m.axis)) {
    // The cap that the film sees, and a little more.
    float widest = 1.0f;
    HashStream numbers(5);
    for (int i = 0; i < 2000; ++i) widest = std::min(widest, dot(at(m.generate_ray(next_sample(numbers))), m.axis));
    cap_ = std::min(2.0f, 1.3f * (1.0f - widest) + 1e-4f);
  }

  // Returns the radiance at the unit vector n from the centre, towards a ray's start. It is smooth and positive, with
  // no symmetry over the sphere; different in the middle of lenses and at their rims, whose points are known by origins
  // or by directions.
  double radiance(Vec3 n, const Ray& ray) const {
    const double x = n.x, y = n.y, z = n.z;
    const Vec3 off = ray.o - centre_, sideways = cross(ray.d, frame_.z);
    const double lens = std::exp(-20.0f * dot(off, off)) + std::exp(-120.0f * dot(sideways, sideways));
    return (2.0 + 0.7 * x - 0.5 * y + 0.4 * z + 0.6 * x * y - 0.3 * y * z) * (0.2 + lens);
  }
  // Returns where the ray, which starts within, meets the sphere.
  Vec3 at(const Ray& ray) const {
    const Vec3 way = ray.o - centre_;
    const float b = dot(way, ray.d);
    return normalize(way + ray.d * (std::sqrt(b * b - dot(way, way) + kRadius * kRadius) - b));
  }
  struct Place {
    Vec3 n;
    Point3 p;
    double pdf_area;
  };
  // Most of them in the cap, some anywhere.
  Place sample(HashStream& numbers) const {
    const bool anywhere = numbers.next_float() < kAnywhere;
    const Vec2 u = next_2d(numbers);
    Vec3 n = sample_sphere_uniform(u);
    if (!anywhere) {
      const float z = 1.0f - cap_ * u.x, r = safe_sqrt(1.0f - z * z), phi = 2.0f * kPi * u.y;
      n = frame_.to_world({r * std::cos(phi), r * std::sin(phi), z});
    }
    const bool in_cap = dot(n, frame_.z) >= 1.0f - cap_;
    const double share = static_cast<double>(kAnywhere);
    const double pdf = share / (4.0 * kPiD) + (in_cap ? (1.0 - share) / (2.0 * kPiD * static_cast<double>(cap_)) : 0.0);
    return {n, centre_ + n * kRadius, pdf / sqr(double{kRadius})};
  }

 private:
  Point3 centre_;
  Frame frame_;
  float cap_;
};

// The film in cells of 4 x 4 pixels.
constexpr int kCell = 4, kAcross = kWidth / kCell, kDown = kHeight / kCell, kCells = kAcross * kDown;

// The mean radiance of a cell by camera rays, and whether none of them leaves the camera nearly sideways.
struct CellByRays {
  RunningStats radiance;
  bool is_seen_well = true;
};

// The last one is the whole film.
using Rays = std::array<CellByRays, kCells + 1>;

// Estimates of the mean radiance of each cell and of the film.
class CellEstimate {
 public:
  // What one sample brings to a film position, as a value per pixel there.
  void splat(Vec2 film, double value) {
    const int x = std::clamp(static_cast<int>(film.x) / kCell, 0, kAcross - 1);
    const int y = std::clamp(static_cast<int>(film.y) / kCell, 0, kDown - 1);
    cells_[static_cast<size_t>(y * kAcross + x)].add(value / (kCell * kCell));
    cells_[kCells].add(value / (kWidth * kHeight));
  }
  void compare(const Rays& rays, size_t samples, WorstP& out) const {
    const double n = static_cast<double>(samples);
    double largest = 0;
    for (const Cell& c : cells_) largest = std::max(largest, c.weight());
    bool any = false, may = false;
    for (size_t i = 0; i < cells_.size(); ++i) {
      if (!rays[i].is_seen_well) continue;
      may = true;
      const Cell& c = cells_[i];
      const double a = c.sum / n, b = rays[i].radiance.mean();
      const double weight = (c.sum > 0.0 ? c.weight() : largest) + n * rays[i].radiance.variance_of_mean() / b;
      // Few bright samples tell nothing. What is expected decides on that, not what was found.
      const double count = n * a / weight, expected = n * b / weight;
      const bool judged = expected >= kLeastCount;
      any |= judged;
      const double p = std::min(gamma_q(count + 1.0, expected), count > 0.0 ? 1.0 - gamma_q(count, expected) : 1.0);
      out.add((count - expected) / std::sqrt(expected), judged ? std::min(1.0, 2.0 * p) : 1.0, [&] {
        const std::string where = i < kCells ? fmt::format("cell ({}, {})", i % kAcross, i / kAcross) : "whole film";
        return fmt::format("{}: {:.6g}, by rays {:.6g}", where, a, b);
      });
    }
    if (may && !any) out.add(0.0, 0.0, [] { return "no cell is seen"; });
  }

 private:
  static constexpr double kLeastCount = 30;
  // The sum is taken for a Poisson variable times a weight, which is right in mean and variance and, unlike the normal
  // distribution, about right in its tails.
  struct Cell {
    double sum = 0, squares = 0;
    void add(double value) { sum += value, squares += sqr(value); }
    double weight() const { return sum > 0.0 ? squares / sum : 0.0; }
  };
  std::array<Cell, kCells + 1> cells_;
};

}  // namespace

void check_measurement(const CameraModel& m, size_t samples, uint64_t seed, WorstP& connected, WorstP& chance) {
  const Surroundings around(m);
  HashStream numbers(seed);
  Rays rays;
  for (size_t i = 0; i < samples; ++i) {
    CameraSample s = next_sample(numbers);
    const auto cell = static_cast<int>(i % kCells);
    s.film = {s.film.x / kAcross + static_cast<float>(cell % kAcross * kCell),
              s.film.y / kDown + static_cast<float>(cell / kAcross * kCell)};
    const Ray ray = m.generate_ray(s);
    const double radiance = around.radiance(around.at(ray), ray);
    for (CellByRays* c : {&rays[static_cast<size_t>(cell)], &rays[kCells]}) {
      c->radiance.add(radiance);
      c->is_seen_well &= !is_sideways(m, ray.d);
    }
  }
  CellEstimate by_connection, by_chance;
  for (size_t i = 0; i < samples; ++i) {
    const auto place = around.sample(numbers);
    const Vec2 u = next_2d(numbers);
    const float time = m.ray_time(numbers.next_float());
    if (const auto c = m.sample_wi(place.p, u, time, 0)) {
      const double light = around.radiance(place.n, {place.p + c->wi * c->distance, -c->wi}) / place.pdf_area;
      by_connection.splat(c->importance.film, light * double{c->weight} * -dot(place.n, c->wi));
    }
    if (!m.lens) continue;
    const Window window = m.lens(time);
    const Vec3d normal = cross(window.a, window.b);
    const Point3d o = window.corner + window.a * double{u.x} + window.b * double{u.y};
    const Vec3d way = to_double(place.p) - o;
    const double d2 = dot(way, way);
    const Ray ray{to_float(o), to_float(normalize(way)), kInfinity, time};
    const auto i_ray = m.we(ray, 0);
    if (!i_ray) continue;
    // cos dA of the lens, and cos / d^2 of the sphere.
    const double at_lens = std::abs(dot(to_double(ray.d), normal)), at_sphere = double{dot(place.n, ray.d)} / d2;
    const double light = around.radiance(place.n, ray) / place.pdf_area;
    by_chance.splat(i_ray->film, light * double{i_ray->we()} * at_lens * at_sphere);
  }
  by_connection.compare(rays, samples, connected);
  if (m.lens) by_chance.compare(rays, samples, chance);
}

}  // namespace etd
