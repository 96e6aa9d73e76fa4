// Checks of a closure's delta lobes: they are few and their probabilities discrete, so everything is exact.
#include <fmt/format.h>

#include "verify/battery/bsdf/checks.h"

namespace etd::bsdf_checks {

namespace {

double distance(Vec3 a, Vec3 b) { return static_cast<double>(length(a - b)); }

// The value of the lobe: what it multiplies a beam by.
Spectrum value(const BsdfSample& s) { return s.weight * s.pdf; }

double difference(const Spectrum& a, const Spectrum& b) {
  double d = 0;
  for (int i = 0; i < Spectrum::kLanes; ++i) d = std::max(d, std::abs(static_cast<double>(a[i]) - b[i]));
  return d;
}

const DeltaLobe* find_side(const std::vector<DeltaLobe>& lobes, bool transmission) {
  for (const DeltaLobe& l : lobes)
    if (l.sample.is_transmission() == transmission) return &l;
  return nullptr;
}

// Refraction keeps the tangential component times the index (Snell); a mirror turns it.
double direction_error(Vec3 wo, const BsdfSample& s) {
  if (!s.is_transmission()) return distance(s.wi, {-wo.x, -wo.y, wo.z});
  const double tangential = std::hypot(s.wi.x * s.eta + wo.x, s.wi.y * s.eta + wo.y);
  return tangential + (s.wi.z * wo.z < 0.0f ? 0.0 : 1.0);
}

struct DeltaChecks {
  Worst probability, direction, sides, radiance, reciprocity;

  explicit DeltaChecks(const ScatterModel& m)
      : probability(m.name, "delta probabilities", 2.0 / kDeltaSteps),
        direction(m.name, "delta directions (Snell)", 1e-5),
        sides(m.name, "delta values on chosen sides", 1e-5),
        radiance(m.name, "delta radiance / importance", 1e-5),
        reciprocity(m.name, "delta reciprocity", 1e-4) {}
};

void check_direction(const ScatterModel& m, Vec3 wo, DeltaChecks& c) {
  const auto where = [&] { return describe(wo, TransportMode::kImportance); };
  const auto lobes = find_delta_lobes(m, wo, TransportMode::kImportance, kBothSides);
  for (const DeltaLobe& l : lobes) {
    const BsdfSample& s = l.sample;
    c.probability.add(std::abs(l.share - static_cast<double>(s.pdf)), where);
    c.direction.add(direction_error(wo, s), where);
    const bool transmission = s.is_transmission();

    // One side alone has the same value, however its probability changes.
    const Lobe side = transmission ? kTransmission : kReflection;
    const auto alone = find_delta_lobes(m, wo, TransportMode::kImportance, side);
    const DeltaLobe* same = find_side(alone, transmission);
    c.sides.add(same ? difference(value(same->sample), value(s)) : 1.0, where);
    c.sides.add(find_side(alone, !transmission) ? 1.0 : 0.0, where);

    const auto as_radiance = find_delta_lobes(m, wo, TransportMode::kRadiance, kBothSides);
    const DeltaLobe* radiance = find_side(as_radiance, transmission);
    c.radiance.add(radiance ? difference(value(radiance->sample) * (s.eta * s.eta), value(s)) : 1.0, where);

    // The way back has the same value and ends where this began. It may be too rare to be found when it is nearly 0.
    if (l.share < 0.01) continue;
    const auto reversed = find_delta_lobes(m, s.wi, TransportMode::kImportance, kBothSides);
    const DeltaLobe* back = find_side(reversed, transmission);
    c.reciprocity.add(back ? difference(value(back->sample), value(s)) : 1.0, where);
    if (back) c.reciprocity.add(distance(back->sample.wi, wo), where);
  }
}

// On a tilted surface the same beams carry radiance and importance, whose values differ by the index and by the factor
// between f |cos| of the shading and of the geometric normal.
void check_adjoint(const ScatterModel& m, Vec3 viewer, Worst& adjoint) {
  for (const DeltaLobe& l : find_delta_lobes(m, viewer, TransportMode::kRadiance, kBothSides)) {
    const Vec3 light = l.sample.wi;
    const auto where = [&] { return describe(viewer, TransportMode::kRadiance); };
    const float factor = sqr(l.sample.eta) * std::abs(dot(light, m.ns) * viewer.z / (dot(viewer, m.ns) * light.z));
    const auto back = find_delta_lobes(m, light, TransportMode::kImportance, kBothSides);
    const auto same = std::find_if(back.begin(), back.end(),
                                   [&](const DeltaLobe& b) { return distance(b.sample.wi, viewer) < 1e-4; });
    if (same == back.end()) {
      adjoint.add(l.share < 0.01 ? 0.0 : 1.0, where);
      continue;
    }
    for (int i = 0; i < Spectrum::kLanes; ++i)
      adjoint.add_relative(value(same->sample)[i], value(l.sample)[i] * factor, where);
  }
}

}  // namespace

std::vector<DeltaLobe> find_delta_lobes(const ScatterModel& m, Vec3 wo, TransportMode mode, Lobe sides) {
  std::vector<DeltaLobe> lobes;
  HashStream rng(0);
  for (int i = 0; i < kDeltaSteps; ++i) {
    const Vec3 u{0.3f, 0.7f, (static_cast<float>(i) + 0.5f) / kDeltaSteps};
    const auto s = m.sample(wo, u, mode, rng, sides);
    if (!s || !s->is_delta()) continue;
    auto same = std::find_if(lobes.begin(), lobes.end(), [&](const DeltaLobe& l) {
      return l.sample.lobe == s->lobe && distance(l.sample.wi, s->wi) < 1e-6;
    });
    if (same == lobes.end()) same = lobes.insert(lobes.end(), DeltaLobe{*s, 0.0});
    same->share += 1.0 / kDeltaSteps;
  }
  return lobes;
}

void check_delta(const ScatterModel& m, Results& out) {
  if (m.is_tilted()) {
    Worst adjoint(m.name, "delta importance is adjoint", 1e-3);
    for (const Vec3& viewer : test_directions()) check_adjoint(m, viewer, adjoint);
    out.push_back(adjoint.result());
    return;
  }
  DeltaChecks c(m);
  for (const Vec3& wo : test_directions()) check_direction(m, wo, c);
  for (const Worst* w : {&c.probability, &c.direction, &c.sides, &c.radiance}) out.push_back(w->result());
  if (m.traits.reciprocal) out.push_back(c.reciprocity.result());
}

}  // namespace etd::bsdf_checks
