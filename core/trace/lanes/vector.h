// Part of walk/kernel.h's files: vectors of lanes. Every operation has GLM's order, so that the lanes'
// pictures are those of the scalar code.
#pragma once

#include "core/math/luminance.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

struct Vec {
  Float x, y, z;
  Vec() = default;
  Vec(Float a, Float b, Float c) : x(a), y(b), z(c) {}
  explicit Vec(Float all) : x(all), y(all), z(all) {}
  Vec(const glm::vec3& v) : x(v.x), y(v.y), z(v.z) {}  // NOLINT: all lanes

  static Vec load(const float* const (&columns)[3], std::size_t i) {
    return {Float::load(columns[0] + i), Float::load(columns[1] + i), Float::load(columns[2] + i)};
  }
};
inline Vec operator+(const Vec& a, const Vec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(const Vec& a, const Vec& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Vec operator*(const Vec& a, Float s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline Vec operator*(Float s, const Vec& a) {
  return a * s;
}
inline Vec operator/(const Vec& a, Float s) {
  return {a.x / s, a.y / s, a.z / s};
}
inline Vec operator-(const Vec& a) {
  return {-a.x, -a.y, -a.z};
}
inline Vec& operator+=(Vec& a, const Vec& b) {
  return a = a + b;
}
inline Vec& operator*=(Vec& a, const Vec& b) {
  return a = a * b;
}
inline Vec& operator*=(Vec& a, Float s) {
  return a = a * s;
}
inline Vec& operator/=(Vec& a, Float s) {
  return a = a / s;
}
inline Mask operator==(const Vec& a, const Vec& b) {
  return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
}
inline Mask operator!=(const Vec& a, const Vec& b) {
  return ~(a == b);
}
inline Vec select(Mask m, const Vec& yes, const Vec& no) {
  return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}
inline Float dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
inline Vec normalize(const Vec& a) {
  return a * (Float(1.0f) / sqrt(dot(a, a)));
}
inline Float largest(const Vec& a) {
  return max(max(a.x, a.y), a.z);
}
inline Vec abs(const Vec& a) {
  return {abs(a.x), abs(a.y), abs(a.z)};
}
inline Float clamp(Float a, float lo, float hi) {
  return min(Float(hi), max(Float(lo), a));
}
inline Vec reflect(const Vec& incoming, const Vec& n) {
  return incoming - n * dot(n, incoming) * Float(2.0f);
}

// A point in double.
struct DoubleVec {
  Double x, y, z;
};

// Calls visit(value, lanes) for each distinct value among `lanes`: its data is read once and broadcast under
// a mask, which is faster than a gather where neighbours see the same and no slower where they do not.
template <class Visit>
inline void for_each_distinct(Int values, Mask lanes, Visit visit) {
  alignas(64) std::uint32_t value[kWidth];
  values.store(value);
  unsigned waiting = lanes.bits();
  for (int lane = 0; waiting != 0;) {
    // A branch on purpose: where most values differ, the processor predicts that the next lane is next and
    // does not wait for the comparison.
    if ((waiting >> lane & 1) == 0) [[unlikely]]
      lane = __builtin_ctz(waiting);
    const std::uint32_t one = value[lane++];
    const Mask same = lanes & (values == Int(one));
    visit(one, same);
    waiting &= ~same.bits();
  }
}

inline Float luminance(const Vec& rgb) {
  return Float(kLuminance.r) * rgb.x + Float(kLuminance.g) * rgb.y + Float(kLuminance.b) * rgb.z;
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
