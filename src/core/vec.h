// Vectors and points as distinct types: a point minus a point is a vector, a point plus a point does not compile.
// Float in the renderer, double where transforms are composed. Normals are vectors; only transforms treat them
// differently (core/transform.h).
#pragma once

#include "core/math.h"

namespace etd {

template <class T>
struct Vec2T {
  T x = 0, y = 0;
  friend constexpr bool operator==(const Vec2T&, const Vec2T&) = default;
};
using Vec2 = Vec2T<float>;

template <class T>
struct Vec3T {
  T x = 0, y = 0, z = 0;

  constexpr T operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr T& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr Vec3T operator-() const { return {-x, -y, -z}; }
  constexpr Vec3T& operator+=(Vec3T b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  friend constexpr Vec3T operator+(Vec3T a, Vec3T b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3T operator-(Vec3T a, Vec3T b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3T operator*(Vec3T a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3T operator*(T s, Vec3T a) { return a * s; }
  friend constexpr Vec3T operator/(Vec3T a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(const Vec3T&, const Vec3T&) = default;
};
using Vec3 = Vec3T<float>;
using Vec3d = Vec3T<double>;

template <class T>
struct Point3T {
  T x = 0, y = 0, z = 0;

  constexpr T operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr T& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
  friend constexpr Point3T operator+(Point3T p, Vec3T<T> v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
  friend constexpr Point3T operator-(Point3T p, Vec3T<T> v) { return {p.x - v.x, p.y - v.y, p.z - v.z}; }
  friend constexpr Vec3T<T> operator-(Point3T a, Point3T b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr bool operator==(const Point3T&, const Point3T&) = default;
};
using Point3 = Point3T<float>;
using Point3d = Point3T<double>;

template <class T>
constexpr T dot(Vec3T<T> a, Vec3T<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3T<T> cross(Vec3T<T> a, Vec3T<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(Vec3T<T> v) {
  return std::sqrt(dot(v, v));
}
// Unit vector along v; a zero vector gives NaNs.
template <class T>
Vec3T<T> normalize(Vec3T<T> v) {
  return v * (T(1) / length(v));
}
template <class T>
T max_component(Vec3T<T> v) {
  return std::max(v.x, std::max(v.y, v.z));
}
template <class T>
Vec3T<T> abs(Vec3T<T> v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}
template <class T>
bool is_finite(Vec3T<T> v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
// v turned into the half space of n.
ETD_FN Vec3 face_forward(Vec3 v, Vec3 n) { return dot(v, n) < 0.0f ? -v : v; }

inline Vec3d to_double(Vec3 v) { return {v.x, v.y, v.z}; }
inline Point3d to_double(Point3 p) { return {p.x, p.y, p.z}; }
inline Vec3 to_float(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
inline Point3 to_float(Point3d p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

}  // namespace etd
