#include "core/animated_transform.h"

#include <algorithm>

namespace etd {

namespace {

// Half angles of less than 1.8 degrees.
constexpr double kLinearCosine = 0.9995;
constexpr size_t kMostSteps = 128;  // Embree takes 129 keys

double dot(const Quaternion& a, const Quaternion& b) { return a.r * b.r + a.i * b.i + a.j * b.j + a.k * b.k; }

Quaternion sum(const Quaternion& a, double wa, const Quaternion& b, double wb) {
  return {wa * a.r + wb * b.r, wa * a.i + wb * b.i, wa * a.j + wb * b.j, wa * a.k + wb * b.k};
}

Quaternion normalize(const Quaternion& q) { return sum(q, 1.0 / std::sqrt(dot(q, q)), {}, 0.0); }

Quaternion slerp(const Quaternion& a, Quaternion b, double t) {
  double cosine = dot(a, b);
  if (cosine < 0) b = sum(b, -1, {}, 0), cosine = -cosine;
  if (cosine > kLinearCosine) return normalize(sum(a, 1 - t, b, t));
  const double angle = t * std::acos(cosine);
  return sum(a, std::cos(angle), normalize(sum(b, 1, a, -cosine)), std::sin(angle));
}

// Makes a quaternion from the columns of a rotation, dividing by the largest component (Shepperd 1978).
Quaternion quaternion_of(Vec3d x, Vec3d y, Vec3d z) {
  const double four_squares[4] = {1 + x.x + y.y + z.z, 1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z};
  const auto largest = std::max_element(four_squares, four_squares + 4) - four_squares;
  const double s = 0.5 / std::sqrt(four_squares[largest]), own = s * four_squares[largest];
  if (largest == 0) return {own, s * (y.z - z.y), s * (z.x - x.z), s * (x.y - y.x)};
  if (largest == 1) return {s * (y.z - z.y), own, s * (x.y + y.x), s * (z.x + x.z)};
  if (largest == 2) return {s * (z.x - x.z), s * (x.y + y.x), own, s * (y.z + z.y)};
  return {s * (x.y - y.x), s * (z.x + x.z), s * (y.z + z.y), own};
}

Vec3d column(const Mat4& m, size_t i) { return {m.m[0][i], m.m[1][i], m.m[2][i]}; }

Mat4 from_columns(Vec3d x, Vec3d y, Vec3d z, Vec3d t) {
  Mat4 m;
  for (int i = 0; i < 3; ++i) m.m[static_cast<size_t>(i)] = {x[i], y[i], z[i], t[i]};
  return m;
}

struct Axes {
  Vec3d x, y, z;
  Vec3d operator*(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
};

Axes rotation(const Quaternion& q) {
  return {{1 - 2 * (q.j * q.j + q.k * q.k), 2 * (q.i * q.j + q.r * q.k), 2 * (q.i * q.k - q.r * q.j)},
          {2 * (q.i * q.j - q.r * q.k), 1 - 2 * (q.i * q.i + q.k * q.k), 2 * (q.j * q.k + q.r * q.i)},
          {2 * (q.i * q.k + q.r * q.j), 2 * (q.j * q.k - q.r * q.i), 1 - 2 * (q.i * q.i + q.j * q.j)}};
}

// p -> T R (S p + shift), and back.
Transform compose(const TransformParts& p, Vec3d shift) {
  const Axes r = rotation(p.rotation);
  const Vec3d s = p.scale, k = p.skew, d{1 / s.x, 1 / s.y, 1 / s.z}, t = p.translation + r * shift;
  const Mat4 m = from_columns(r.x * s.x, r.x * k.x + r.y * s.y, r.x * k.y + r.y * k.z + r.z * s.z, t);
  const Vec3d rows[3] = {r.x * d.x - r.y * (k.x * d.x * d.y) + r.z * ((k.x * k.z - k.y * s.y) * d.x * d.y * d.z),
                         r.y * d.y - r.z * (k.z * d.y * d.z), r.z * d.z};
  Mat4 inverse;
  for (size_t i = 0; i < 3; ++i) inverse.m[i] = {rows[i].x, rows[i].y, rows[i].z, -dot(rows[i], t)};
  return {m, inverse};
}

TransformParts parts_of(const AnimatedTransform::Key& k) {
  return {to_double(k.translation), {k.r, k.i, k.j, k.k}, to_double(k.scale), to_double(k.skew)};
}

double largest_entry(const Mat4& a, const Mat4& b, size_t first_column, size_t last_column) {
  double largest = 0;
  for (size_t row = 0; row < 3; ++row)
    for (size_t i = first_column; i <= last_column; ++i)
      largest = std::max(largest, std::abs(a.m[row][i] - b.m[row][i]));
  return largest;
}

// Whether the parts at even steps describe the path, for points at most `size` away from 0.
bool follows(const std::vector<TransformParts>& parts, const TransformPath& path, double size) {
  constexpr double kTolerance = 4e-6;
  const size_t steps = parts.size() - 1;
  const Mat4 zero = from_columns({}, {}, {}, {});
  for (size_t k = 0; k < steps; ++k) {
    if (!(dot(parts[k].rotation, parts[k + 1].rotation) > kLinearCosine)) return false;
    for (const double share : {0.25, 0.5, 0.75}) {
      const Mat4 wanted = path.at((static_cast<double>(k) + share) / static_cast<double>(steps)).matrix();
      const Mat4 found = TransformParts::between(parts[k], parts[k + 1], share).transform().matrix();
      const double off = largest_entry(wanted, found, 0, 2) * size + largest_entry(wanted, found, 3, 3);
      if (!(off <= kTolerance * (largest_entry(wanted, zero, 0, 2) * size + 1e-6 * largest_entry(wanted, zero, 3, 3))))
        return false;
    }
  }
  return true;
}

}  // namespace

TransformParts TransformParts::of(const Mat4& m) {
  // Gram-Schmidt on the columns; the third axis completes a right-handed frame.
  const Vec3d a = column(m, 0), b = column(m, 1), c = column(m, 2);
  TransformParts p;
  p.translation = column(m, 3);
  p.scale.x = length(a);
  const Vec3d x = a * (1.0 / p.scale.x);
  p.skew.x = dot(x, b);
  const Vec3d across = b - x * p.skew.x;
  p.scale.y = length(across);
  const Vec3d y = across * (1.0 / p.scale.y), z = cross(x, y);
  p.skew.y = dot(x, c);
  p.skew.z = dot(y, c);
  p.scale.z = dot(z, c);
  p.rotation = quaternion_of(x, y, z);
  return p;
}

TransformParts TransformParts::between(const TransformParts& a, const TransformParts& b, double t) {
  const auto lerp = [t](Vec3d from, Vec3d to) { return from * (1 - t) + to * t; };
  return {lerp(a.translation, b.translation), slerp(a.rotation, b.rotation, t), lerp(a.scale, b.scale),
          lerp(a.skew, b.skew)};
}

Transform TransformParts::rest() const { return compose({{}, {}, scale, skew}, {}); }

Transform TransformParts::transform() const { return compose(*this, {}); }

void TransformPath::append(const Factor& factor) {
  if (!factor.moves && !factors_.empty() && !factors_.back().moves)
    factors_.back().always = factors_.back().always * factor.always;
  else
    factors_.push_back(factor);
}

TransformPath TransformPath::then(const TransformPair& inner) const {
  TransformPath path = *this;
  if (inner.is_moving())
    path.append({true, {}, TransformParts::of(inner.start.matrix()), TransformParts::of(inner.end.matrix())});
  else
    path.append({false, inner.start, {}, {}});
  return path;
}

TransformPath TransformPath::then(const TransformPath& inner) const {
  TransformPath path = *this;
  for (const Factor& f : inner.factors_) path.append(f);
  return path;
}

bool TransformPath::moves() const {
  return std::any_of(factors_.begin(), factors_.end(), [](const Factor& f) { return f.moves; });
}

Transform TransformPath::at(double time) const {
  Transform product;
  for (const Factor& f : factors_)
    product = product * (f.moves ? TransformParts::between(f.start, f.end, time).transform() : f.always);
  return product;
}

AnimatedTransform::AnimatedTransform(const TransformPath& path, Vec3d centre, double size) {
  std::vector<TransformParts> parts;
  for (size_t steps = 1; steps <= kMostSteps; steps *= 2) {
    parts.clear();
    for (size_t k = 0; k <= steps; ++k) {
      parts.push_back(TransformParts::of(path.at(static_cast<double>(k) / static_cast<double>(steps)).matrix()));
      Quaternion& q = parts.back().rotation;
      if (k > 0 && dot(parts[k - 1].rotation, q) < 0) q = sum(q, -1, {}, 0);
    }
    if (follows(parts, path, size + length(centre))) break;
  }
  // Without rotation nothing turns around a pivot, and the centre itself can be translated: that loses fewer digits.
  const bool turns = std::any_of(parts.begin(), parts.end(), [&](const TransformParts& p) {
    return dot(p.rotation, parts[0].rotation) < 1 - 1e-14;
  });
  for (TransformParts& p : parts) {
    const Vec3d shift = p.rest().vector(centre);
    if (!turns) p.translation += rotation(p.rotation) * shift;
    const Quaternion& q = p.rotation;
    const auto narrow = [](double x) { return static_cast<float>(x); };
    keys_.push_back({to_float(p.translation), narrow(q.r), narrow(q.i), narrow(q.j), narrow(q.k), to_float(p.scale),
                     to_float(p.skew), turns ? to_float(shift) : Vec3{}});
    pivot_distance_ = std::max(pivot_distance_, length(keys_.back().shift));
  }
}

Transform AnimatedTransform::at(float time) const {
  // The step is found in float, as Embree finds it.
  const float steps = static_cast<float>(keys_.size() - 1), scaled = time * steps;
  const float first = clamp(std::floor(scaled), 0.0f, steps - 1.0f);
  const double share = static_cast<double>(scaled - first);
  const Key &a = keys_[static_cast<size_t>(first)], &b = keys_[static_cast<size_t>(first) + 1];
  return compose(TransformParts::between(parts_of(a), parts_of(b), share),
                 to_double(a.shift) * (1 - share) + to_double(b.shift) * share);
}

bool AnimatedTransform::is_rigid() const {
  return std::all_of(keys_.begin(), keys_.end(), [](const Key& k) {
    const Vec3 off = abs(k.scale - Vec3{1, 1, 1}) + abs(k.skew);
    return max_component(off) < 1e-5f;
  });
}

double AnimatedTransform::mean_area_scale() const {
  const auto area = [](Vec3d s) { return std::pow(std::abs(s.x * s.y * s.z), 2.0 / 3.0); };
  double sum = 0;
  for (size_t k = 0; k + 1 < keys_.size(); ++k) {  // Simpson's rule
    const Vec3d a = to_double(keys_[k].scale), b = to_double(keys_[k + 1].scale);
    sum += (area(a) + 4 * area((a + b) * 0.5) + area(b)) / 6;
  }
  return sum / static_cast<double>(keys_.size() - 1);
}

std::pair<size_t, size_t> AnimatedTransform::keys_between(float start, float end) const {
  const auto steps = static_cast<float>(keys_.size() - 1);
  const float first = clamp(std::floor(start * steps), 0.0f, steps - 1.0f);
  return {static_cast<size_t>(first), static_cast<size_t>(clamp(std::ceil(end * steps), first + 1.0f, steps))};
}

double AnimatedTransform::turn(size_t step) const {
  const double cosine = dot(parts_of(keys_[step]).rotation, parts_of(keys_[step + 1]).rotation);
  return 2 * std::acos(std::min(std::abs(cosine), 1.0));
}

// In a step that turns by the angle a while a point of the space that turns goes from q to q + v, the point is within
// |q| a^2 / 8 + |v| a / 4 of the chord between where it is at the keys, to the second order; twice that is taken.
Bounds3 AnimatedTransform::swept(const Bounds3& box, float start, float end) const {
  const auto [first, last] = keys_between(start, end);
  const auto steps = static_cast<double>(keys_.size() - 1);
  Bounds3 all;
  for (size_t k = first; k < last; ++k) {
    // The times may begin and end within a step.
    const auto share_of = [&](float time) {
      return std::clamp(static_cast<double>(time) * steps - static_cast<double>(k), 0.0, 1.0);
    };
    const double from = share_of(start), to = share_of(end);
    const TransformParts key = parts_of(keys_[k]), next = parts_of(keys_[k + 1]);
    const TransformParts a = TransformParts::between(key, next, from), b = TransformParts::between(key, next, to);
    const Vec3d shift = to_double(keys_[k].shift), next_shift = to_double(keys_[k + 1].shift);
    const Transform own_a = a.rest(), own_b = b.rest();
    const double angle = turn(k) * (to - from) * (1 + 1e-3) + 1e-6;
    for (int i = 0; i < 8; ++i) {
      const Point3d p{(i & 1 ? box.hi : box.lo).x, (i & 2 ? box.hi : box.lo).y, (i & 4 ? box.hi : box.lo).z};
      const Vec3d q = own_a.vector(p - Point3d{}) + shift + (next_shift - shift) * from;
      const Vec3d v = own_b.vector(p - Point3d{}) + shift + (next_shift - shift) * to - q;
      const double margin = length(q) * (sqr(angle) / 4 + 1e-6) + length(v) * angle / 2;
      for (const Point3d at : {Point3d{} + (a.translation + rotation(a.rotation) * q),
                               Point3d{} + (b.translation + rotation(b.rotation) * (q + v))}) {
        all.extend(at + Vec3d{-margin, -margin, -margin});
        all.extend(at + Vec3d{margin, margin, margin});
      }
    }
  }
  return all;
}

}  // namespace etd
