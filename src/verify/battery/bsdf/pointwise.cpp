// Checks of a closure at single directions, without statistics.
#include <fmt/format.h>

#include "verify/battery/bsdf/checks.h"

namespace etd::bsdf_checks {

namespace {

constexpr TransportMode kModes[] = {TransportMode::kRadiance, TransportMode::kImportance};

// 0 for finite and non-negative, else infinity.
double flaw(float x) { return std::isfinite(x) && x >= 0.0f ? 0.0 : HUGE_VAL; }
double flaw(const Spectrum& s) { return flaw(s[0]) + flaw(s[1]) + flaw(s[2]) + flaw(s[3]); }

std::vector<Vec3> awkward_directions() {
  std::vector<Vec3> list{{0, 0, 1}, {0, 0, -1}};
  for (float z : {0.0f, -0.0f, 1e-38f, 1e-30f, 1e-20f, 1e-12f, 1e-6f, 1e-4f, -1e-38f, -1e-20f, -1e-6f}) {
    for (Vec2 t : {Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0.6f, -0.8f}}) list.push_back({t.x, t.y, z});
  }
  for (float z : {0.999999f, 0.5f, -0.3f}) list.push_back({safe_sqrt(1.0f - z * z), 0.0f, z});
  return list;
}

// Every pair of lanes in turn.
template <class F>
void add_lanes(Worst& worst, const Spectrum& a, const Spectrum& b, F&& where) {
  for (int i = 0; i < Spectrum::kLanes; ++i) worst.add_relative(a[i], b[i], where);
}

struct PointwiseChecks {
  Worst weight, density, form, sides, reciprocity, adjoint;

  explicit PointwiseChecks(const ScatterModel& m)
      // The way into a tilted frame and back rounds directions, which sharp lobes feel.
      : weight(m.name, "weight * pdf = eval_cos", m.is_tilted() ? 1e-2 : 1e-3),
        density(m.name, "sample().pdf = pdf()", m.is_tilted() ? 1e-2 : 1e-3),
        form(m.name, "unit wi, lobes as declared", 1e-5),
        sides(m.name, "only allowed sides", 0.0),
        reciprocity(m.name, "reciprocity", 2e-3),
        adjoint(m.name, "importance is adjoint", 2e-3) {}
};

void check_sample(const ScatterModel& m, Vec3 wo, Vec3 u, TransportMode mode, Lobe sides, HashStream& rng,
                  PointwiseChecks& c) {
  const auto s = m.sample(wo, u, mode, rng, sides);
  if (!s) return;
  const auto where = [&] {
    return fmt::format("{}, wi ({:.6g}, {:.6g}, {:.6g})", describe(wo, mode, sides), s->wi.x, s->wi.y, s->wi.z);
  };
  c.form.add(std::abs(length(s->wi) - 1.0f), where);
  c.form.add((s->lobe & ~m.lobes) == 0 && s->eta > 0.0f ? 0.0 : 1.0, where);
  const Lobe side = same_hemisphere(wo, s->wi) ? kReflection : kTransmission;
  c.sides.add((s->lobe & kBothSides) == side && (side & sides) ? 0.0 : 1.0, where);
  if (s->is_delta()) return;

  const float pdf = m.pdf(wo, s->wi, mode, sides);
  const Spectrum f = m.eval_cos(wo, s->wi, mode, rng);
  c.density.add_relative(s->pdf, pdf, where);
  add_lanes(c.weight, s->weight * s->pdf, f, where);
  c.sides.add(static_cast<double>(m.pdf(wo, s->wi, mode, side == kReflection ? kTransmission : kReflection)), where);

  const Spectrum reversed = m.eval_cos(s->wi, wo, mode, rng) / std::abs(wo.z);
  const float eta2 = mode == TransportMode::kRadiance ? s->eta * s->eta : 1.0f / (s->eta * s->eta);
  if (m.traits.reciprocal) add_lanes(c.reciprocity, reversed, f * eta2 / std::abs(s->wi.z), where);
  const TransportMode other = mode == TransportMode::kRadiance ? TransportMode::kImportance : TransportMode::kRadiance;
  const Spectrum adjoint = m.eval_cos(wo, s->wi, other, rng) / std::abs(s->wi.z);
  add_lanes(c.adjoint, reversed, adjoint, where);
}

}  // namespace

void check_finite(const ScatterModel& m, Results& out) {
  Worst finite(m.name, "finite and non-negative", 0.0);
  HashStream rng(0);
  const std::vector<Vec3> directions = awkward_directions();
  for (TransportMode mode : kModes) {
    for (const Vec3& wo : directions) {
      for (const Vec3& wi : directions) {
        finite.add(flaw(m.eval_cos(wo, wi, mode, rng)) + flaw(m.pdf(wo, wi, mode, kBothSides)), [&] {
          return fmt::format("eval_cos or pdf at {}, wi ({:.4g}, {:.4g}, {:.4g})", describe(wo, mode), wi.x, wi.y,
                             wi.z);
        });
      }
      for (float ux : {0.0f, 1e-7f, 0.3f, 0.5f, kOneMinusEpsilon}) {
        for (float uy : {0.0f, 1e-7f, 0.3f, 0.5f, kOneMinusEpsilon}) {
          for (float uz : {0.0f, 0.5f, kOneMinusEpsilon}) {
            const auto s = m.sample(wo, {ux, uy, uz}, mode, rng, kBothSides);
            if (!s) continue;
            const bool sound = is_finite(s->wi) && s->pdf > 0.0f && s->wi.z != 0.0f && wo.z != 0.0f;
            finite.add(sound ? flaw(s->pdf) + flaw(s->weight) : HUGE_VAL, [&] {
              return fmt::format("sample at {}, u ({:.9g}, {:.9g}, {:.9g})", describe(wo, mode), ux, uy, uz);
            });
          }
        }
      }
    }
  }
  out.push_back(finite.result());
}

void check_pointwise(const ScatterModel& m, uint64_t seed, Results& out) {
  PointwiseChecks c(m);
  HashStream numbers(hash_combine(seed, 1)), rng(0);
  for (const Vec3& wo : test_directions()) {
    for (TransportMode mode : kModes) {
      for (Lobe sides : {kBothSides, kReflection, kTransmission, kNoLobe}) {
        for (int i = 0; i < 300; ++i) {
          const Vec3 u{numbers.next_float(), numbers.next_float(), numbers.next_float()};
          check_sample(m, wo, u, mode, sides, rng, c);
        }
      }
      if (m.has_smooth()) continue;
      for (int i = 0; i < 50; ++i) {
        const float z = 2.0f * numbers.next_float() - 1.0f, r = safe_sqrt(1.0f - z * z),
                    phi = 6.0f * numbers.next_float();
        const Vec3 wi{r * std::cos(phi), r * std::sin(phi), z};
        const float value = max_value(m.eval_cos(wo, wi, mode, rng)) + m.pdf(wo, wi, mode, kBothSides);
        c.density.add(static_cast<double>(value),
                      [&] { return "not 0 without smooth lobes at " + describe(wo, mode); });
      }
    }
  }
  for (const Worst* w : {&c.weight, &c.density, &c.form, &c.sides, &c.adjoint}) out.push_back(w->result());
  if (m.traits.reciprocal) out.push_back(c.reciprocity.result());
}

}  // namespace etd::bsdf_checks
