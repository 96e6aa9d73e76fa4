// The battery over samplers: stratification that must hold exactly, uniformity and independence as statistical tests,
// and that a number depends on nothing but its place.
#include "samplers/sampler.h"

#include <fmt/format.h>

#include <memory>
#include <set>

#include "verify/battery/models.h"
#include "verify/battery/worst.h"

namespace etd {

namespace {

// Every box of the form [i/2^a, (i+1)/2^a) x [j/2^b, (j+1)/2^b) with a + b = m holds one of 2^m points of an aligned
// block of indices; the same for numbers along one axis.
CheckResult check_elementary_intervals(const SamplerModel& model, uint64_t seed) {
  Worst worst(model.name, "elementary intervals", 0.0);
  for (uint32_t run = 0; run < 24; ++run) {
    const SamplerFunctions s = model.make(seed + run);
    for (uint32_t m = 0; m <= 9; ++m) {
      const uint32_t n = 1u << m, first = run % 3 * n;
      std::vector<Vec2> points;
      std::set<uint32_t> lines, choices;
      for (uint32_t i = first; i < first + n; ++i) {
        s.start(77 * run, run % 2, i);
        s.set_dimension(run);
        points.push_back(s.get_2d());
        lines.insert(static_cast<uint32_t>(s.get_1d() * static_cast<float>(n)));
        choices.insert(static_cast<uint32_t>(s.get_choice() * n));
      }
      const auto where = [&] { return fmt::format("run {}, {} points", run, n); };
      worst.add(static_cast<double>(2 * n - lines.size() - choices.size()), where);
      for (uint32_t a = 0; a <= m; ++a) {
        std::vector<uint8_t> seen(n, 0);
        double empty = n;
        for (const Vec2 p : points) {
          const auto column = static_cast<uint32_t>(p.x * static_cast<float>(1u << a));
          const auto row = static_cast<uint32_t>(p.y * static_cast<float>(1u << (m - a)));
          uint8_t& cell = seen[column << (m - a) | row];
          if (!cell) empty -= 1;
          cell = 1;
        }
        worst.add(empty, where);
      }
    }
  }
  return worst.result();
}

// For a fixed index, the scramble alone makes the value uniform: what unbiasedness rests on.
void check_uniform(const SamplerModel& model, size_t streams, uint64_t seed, Worst& range, WorstP& uniform) {
  constexpr int kCells = 64;
  const SamplerFunctions s = model.make(seed);
  const std::vector<double> expected(kCells, static_cast<double>(streams) / kCells);
  for (const uint32_t index : {0u, 1u, 2u, 7u, 1000u, 0xffffffffu}) {
    std::vector<double> counts[4];
    for (auto& c : counts) c.assign(kCells, 0.0);
    for (uint64_t stream = 0; stream < streams; ++stream) {
      s.start(stream, 0, index);
      const Vec2 xy = s.get_2d();
      const double values[4] = {xy.x, xy.y, s.get_1d(), s.get_choice()};
      for (size_t v = 0; v < 4; ++v) {
        const bool inside = values[v] >= 0.0 && values[v] < 1.0;
        range.add(inside ? 0.0 : 1.0, [&] { return fmt::format("index {}, stream {}", index, stream); });
        if (inside) ++counts[v][static_cast<size_t>(values[v] * kCells)];
      }
    }
    for (size_t v = 0; v < 4; ++v) {
      const TestResult t = chi_square_test(counts[v], expected, 5);
      uniform.add(t.statistic, t.p_value, [&] { return fmt::format("index {}, number {}", index, v); });
    }
  }
}

// Says where a number comes from.
struct Origin {
  uint32_t pixel, replicate, index, dimension;
  std::string text() const {
    return fmt::format("(pixel {}, replicate {}, index {}, dimension {})", pixel, replicate, index, dimension);
  }
};

// Numbers of different pixels, replicates, indices and dimensions, drawn together many times: every pair of them must
// be independent, as their joint histogram tells. Of one dimension of one stream, a stratified sampler's points for
// different indices are meant to depend on each other, and are left out.
CheckResult check_independence(const SamplerModel& model, size_t draws, uint64_t seed) {
  constexpr size_t kCells = 8;
  WorstP worst(model.name, "dimensions, pixels, replicates");
  const SamplerFunctions s = model.make(seed);
  const auto cell = [](float v) { return static_cast<uint8_t>(clamp(v, 0.0f, kOneMinusEpsilon) * kCells); };
  std::vector<Origin> origins;
  std::vector<std::vector<uint8_t>> cells;
  for (uint32_t pixel = 0; pixel < 2; ++pixel)
    for (uint32_t replicate = 0; replicate < 2; ++replicate)
      for (uint32_t index = 0; index < 2; ++index)
        for (uint32_t dimension = 0; dimension < 3; ++dimension) {
          std::vector<uint8_t> x, y;
          for (size_t draw = 0; draw < draws; ++draw) {
            s.start(2 * draw + pixel, replicate, index);
            s.set_dimension(dimension);
            const Vec2 u = s.get_2d();
            x.push_back(cell(u.x));
            y.push_back(cell(u.y));
          }
          cells.push_back(std::move(x));
          cells.push_back(std::move(y));
          origins.insert(origins.end(), 2, {pixel, replicate, index, dimension});
        }
  const std::vector<double> expected(kCells * kCells, static_cast<double>(draws) / (kCells * kCells));
  for (size_t a = 0; a < origins.size(); ++a)
    for (size_t b = a + 1; b < origins.size(); ++b) {
      const Origin &o = origins[a], &p = origins[b];
      if (o.pixel == p.pixel && o.replicate == p.replicate && o.dimension == p.dimension && o.index != p.index)
        continue;
      std::vector<double> counts(kCells * kCells, 0.0);
      for (size_t draw = 0; draw < draws; ++draw) ++counts[cells[a][draw] * kCells + cells[b][draw]];
      const TestResult t = chi_square_test(counts, expected, 5);
      worst.add(t.statistic, t.p_value, [&] { return o.text() + " and " + p.text(); });
    }
  return worst.result();
}

CheckResult check_random_access(const SamplerModel& model, uint64_t seed) {
  Worst worst(model.name, "random access", 0.0);
  const SamplerFunctions forwards = model.make(seed), again = model.make(seed);
  for (uint32_t index = 0; index < 200; ++index) {
    forwards.start(1234, 1, index);
    const float a = forwards.get_1d();
    const Vec2 b = forwards.get_2d();
    const Vec3 c = forwards.get_3d();  // two dimensions
    const double d = forwards.get_choice();
    again.start(99, 0, 3);
    again.get_2d();
    again.start(1234, 1, index);
    if (index % 2 == 1) again.fetch(index % 6);  // from before, among or behind those that are drawn
    again.set_dimension(4);
    bool equal = again.get_choice() == d;
    again.set_dimension(2);
    equal &= again.get_3d() == c;
    again.set_dimension(1);
    equal &= again.get_2d() == b;
    again.set_dimension(0);
    equal &= again.get_1d() == a;
    worst.add(equal ? 0.0 : 1.0, [&] { return fmt::format("index {}", index); });
  }
  return worst.result();
}

CheckResult check_keys(const SamplerModel& model, uint64_t first_seed) {
  Worst worst(model.name, "seeds and replicates differ", 0.0);
  std::set<uint64_t> keys;
  for (uint64_t seed = first_seed; seed < first_seed + 64; ++seed) {
    const SamplerFunctions s = model.make(seed);
    for (uint32_t replicate = 0; replicate < 512; ++replicate) {
      s.start(0, replicate, 0);
      keys.insert(s.key());
    }
  }
  worst.add(64.0 * 512.0 - static_cast<double>(keys.size()), [] { return "keys that two of them share"; });
  return worst.result();
}

}  // namespace

SamplerModel sampler_model(const std::string& name) {
  const SamplerKind kind = sampler_kind(name);
  return {name, kind.traits().stratified, [kind](uint64_t seed) {
            const auto s = std::make_shared<Sampler>(kind, seed);
            return SamplerFunctions{.start = [s](uint64_t stream, uint32_t replicate,
                                                 uint32_t index) { s->start(stream, replicate, index); },
                                    .set_dimension = [s](uint32_t dimension) { s->set_dimension(dimension); },
                                    .fetch = [s](uint32_t dimension) { s->fetch(dimension); },
                                    .get_1d = [s] { return s->get_1d(); },
                                    .get_2d = [s] { return s->get_2d(); },
                                    .get_3d = [s] { return s->get_3d(); },
                                    .get_choice = [s] { return s->get_choice(); },
                                    .key = [s] { return s->key(0); }};
          }};
}

std::vector<CheckResult> check_sampler(const SamplerModel& model, const BatteryOptions& options) {
  const auto scaled = [&](double n) { return static_cast<size_t>(options.samples * n); };
  Worst range(model.name, "in [0, 1)", 0.0);
  WorstP uniform(model.name, "uniform at every index");
  check_uniform(model, scaled(1 << 15), options.seed, range, uniform);
  std::vector<CheckResult> results{range.result(), uniform.result(),
                                   check_independence(model, scaled(1 << 13), options.seed),
                                   check_random_access(model, options.seed), check_keys(model, options.seed)};
  if (model.stratified) results.push_back(check_elementary_intervals(model, options.seed));
  judge(results, options.family_level);
  return results;
}

std::vector<BatterySubject> sampler_subjects() {
  std::vector<BatterySubject> subjects;
  for (const ModelDecl* decl : sampler_models())
    subjects.push_back(
        {"sampler", decl->name, decl->name,
         [model = sampler_model(decl->name)](const BatteryOptions& options) { return check_sampler(model, options); }});
  return subjects;
}

}  // namespace etd
