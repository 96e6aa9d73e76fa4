// What a clear coat does to the light that a diffuse surface below it sends and receives. Diffuse light forgets where
// it came from, so little is needed: which share of a beam from outside arrives at the base (a function of its cosine),
// and which share of the base's own light the coat sends back to it (a number). The medium between them only absorbs:
// at the cosine mu light keeps exp(-thickness / mu) of itself on each crossing.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <tuple>

#include "bsdfs/dielectric.h"
#include "bsdfs/rough_dielectric.h"

namespace etd {

inline float coat_transmittance(float thickness, float mu) { return std::exp(-thickness / mu); }

// Shares of diffuse light, which is as bright in all directions.
struct CoatMeans {
  float returned = 0;  // of the base's light: what the coat reflects and the base receives
  float entering = 0;  // of light from outside: what the base receives
};

// Shares of light from outside at one cosine.
struct CoatShares {
  float reflected = 0;  // by the coat
  float entering = 0;   // what the base receives
};

// The means of a smooth coat; errors are below 1e-5.
CoatMeans smooth_coat_means(float eta, float thickness);

// The same of a rough isotropic coat, with what depends on the direction.
class CoatTable {
 public:
  // For other coats the errors below do not hold.
  static bool covers(float eta, float alpha) { return eta >= 1.05f && alpha <= 1.0f; }
  // Integrates over the boundary's facets, which takes about 10 ms. alpha is at least 1e-4.
  CoatTable(float eta, float alpha, float thickness);

  const RoughDielectric& boundary() const { return boundary_; }
  // `returned` has errors below 1e-3 / (1 - returned), which makes 1e-3 of the sum over all reflections.
  const CoatMeans& means() const { return means_; }
  // Returns the shares of light from outside at a cosine in [0, 1]. Up to a thickness of 1 the error of what enters is
  // below 1e-3 of it, and in thicker coats below 1e-3 of what enters at normal incidence. What is reflected is right
  // within 5 %: enough to choose lobes by it.
  CoatShares shares(float cosine) const;

 private:
  static constexpr int kCells = 96;
  using Nodes = std::array<float, kCells + 1>;
  float cosine_of(int node) const;

  RoughDielectric boundary_;
  // Nodes are even steps of asinh(v / width), v = 1 - sqrt(1 - cosine): the shares bend where the cosine is about
  // alpha, and a little at normal incidence.
  float width_, nodes_per_unit_;
  Nodes entering_, reflected_;
  CoatMeans means_;
};

// Owns the tables that materials ask for, each made once. A table stays where it is.
class CoatTables {
 public:
  const CoatTable* find(float eta, float alpha, float thickness);
  size_t size() const { return tables_.size(); }

 private:
  std::map<std::tuple<float, float, float>, std::unique_ptr<const CoatTable>> tables_;
};

}  // namespace etd
