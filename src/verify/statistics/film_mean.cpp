#include "verify/statistics/film_mean.h"

namespace etd {

std::optional<Quantity> parse_quantity(const std::string& text) {
  const size_t dot = text.find('.');
  const std::string component = text.substr(0, dot);
  Quantity q;
  if (component == "beauty")
    q.component = Quantity::Component::kBeauty;
  else if (component == "emission")
    q.component = Quantity::Component::kEmission;
  else if (component == "direct")
    q.component = Quantity::Component::kDirect;
  else if (component == "indirect")
    q.component = Quantity::Component::kIndirect;
  else
    return {};
  if (dot == std::string::npos) return q;
  const size_t channel = std::string("RGB").find(text.substr(dot + 1));
  if (text.size() != dot + 2 || channel == std::string::npos) return {};
  q.channel = static_cast<int>(channel);
  return q;
}

double value(const PixelSums& sums, const Quantity& q) {
  const auto of_channel = [&](size_t c) {
    switch (q.component) {
      case Quantity::Component::kEmission:
        return sums.emission[c];
      case Quantity::Component::kDirect:
        return sums.direct[c];
      case Quantity::Component::kIndirect:
        return sums.indirect[c];
      default:
        return sums.emission[c] + sums.direct[c] + sums.indirect[c];
    }
  };
  const double sum =
      q.channel ? of_channel(static_cast<size_t>(*q.channel)) : (of_channel(0) + of_channel(1) + of_channel(2)) / 3.0;
  return sum / sums.count;
}

RunningStats region_mean(const Film& film, const PixelBounds& region, const Quantity& quantity, double factor) {
  RunningStats stats;
  for (uint32_t r = 0; r < film.settings().replicates; ++r) {
    double sum = 0;
    for (int y = region.y0; y < region.y1; ++y)
      for (int x = region.x0; x < region.x1; ++x) sum += value(film.sums(x, y, r), quantity);
    stats.add(factor * sum / (static_cast<double>(region.width()) * region.height()));
  }
  return stats;
}

RunningStats image_mean(const Film& film, const Quantity& quantity) {
  return region_mean(film, film.settings().crop, quantity);
}

double effective_samples(const Film& film, const PixelBounds& region) {
  if (film.settings().replicates >= kReplicatesForSpread) {
    const RunningStats mean = region_mean(film, region, {});
    return mean.variance_of_mean() > 0.0 ? sqr(mean.mean()) / mean.variance_of_mean() : HUGE_VAL;
  }
  double sum = 0, squares = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      const PixelSums light = film.light(x, y);
      sum += light.mean_radiance()[3] * light.count;
      squares += light.squares[3];
    }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

}  // namespace etd
