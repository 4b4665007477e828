// Part of denoise_kernel.cpp.in: an a-trous filter whose weights follow the surfaces and the noise (Dammertz
// et al. 2010, "Edge-avoiding a-trous wavelet transform"; Schied et al. 2017, "Spatiotemporal variance-guided
// filtering", the spatial part). A pixel's weight is h exp(-x), where x adds up how far its normal, distance,
// albedo and luminance are off.
#pragma once

#include <cstddef>

#include "core/denoise/denoise_steps.h"
#include "core/math/luminance.h"
#include "pinocchio/conversion.h"
#include "pinocchio/ray.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

constexpr float kSpline[] = {0.0625f, 0.25f, 0.375f, 0.25f, 0.0625f};  // B3, across and down
static_assert(sizeof(kSpline) / sizeof(*kSpline) == 2 * kDenoiseRadius + 1);

constexpr float kOfNormal = 12.0f;          // x per 1 - cosine of the angle between normals
constexpr float kOfAlbedo = 4.0f;           // x per squared relative difference of albedos
constexpr float kSmallestContrast = 1e-4f;  // squared: a share of the luminance below which contrast is noise
constexpr float kOffPlane = 0.5f;           // of the slope of the distance, that counts as x = 1
constexpr float kOffDistance = 0.002f;      // of the distance, likewise

inline Float load_anywhere(const float* p) {
  using Unaligned [[gnu::aligned(4), gnu::may_alias]] = NativeFloat;
  return Float::of(*reinterpret_cast<const Unaligned*>(p));
}

// exp(-x), 0 from x = 4 on, and where x is no number.
inline Float falloff(Float x) {
  const Float left = Float(1.0f) - Float(0.25f) * x, square = left * left;
  return select(x < Float(4.0f), square * square, Float(0.0f));
}

inline Float luminance(const Float (&rgb)[3]) {
  return Float(kLuminance.r) * rgb[0] + Float(kLuminance.g) * rgb[1] + Float(kLuminance.b) * rgb[2];
}

// The surface that a packet's pixels see.
struct Seen {
  Float normal[3], distance, slope_x, slope_y, albedo;

  Seen(const DenoiseGuides& g, std::ptrdiff_t at) {
    for (int c = 0; c < 3; ++c) normal[c] = Float::load(g.normal[c] + at);
    distance = Float::load(g.distance + at);
    albedo = Float::load(g.albedo + at);
    slope_x = slope(g.distance + at, 1);
    slope_y = slope(g.distance + at, g.stride);
  }

  // How far the pixels at `to` are off, which are dx and dy pixels away. tolerance: squared, its inverse.
  [[gnu::always_inline]] Float off(const DenoiseGuides& g, std::ptrdiff_t to, int dx, int dy,
                                   Float tolerance) const {
    Float cosine = normal[0] * load_anywhere(g.normal[0] + to);
    for (int c = 1; c < 3; ++c) cosine = cosine + normal[c] * load_anywhere(g.normal[c] + to);
    const Float flat = distance + slope_x * Float(as_float(dx)) + slope_y * Float(as_float(dy));
    const Float dz = load_anywhere(g.distance + to) - flat, da = load_anywhere(g.albedo + to) - albedo;
    return Float(kOfNormal) * (Float(1.0f) - cosine) + dz * dz * tolerance + da * da * albedo_tolerance();
  }
  [[nodiscard]] Float tolerance(int step) const {
    const Float length =
        Float(kOffPlane * as_float(step)) * (abs(slope_x) + abs(slope_y)) + Float(kOffDistance) * distance;
    return Float(1.0f) / (length * length);
  }

 private:
  // The smaller one of the differences to both sides: the other may lead to another surface.
  static Float slope(const float* at, std::ptrdiff_t step) {
    const Float here = Float::load(at), on = load_anywhere(at + step) - here,
                back = here - load_anywhere(at - step);
    return select(abs(on) < abs(back), on, back);
  }
  [[nodiscard]] Float albedo_tolerance() const { return Float(kOfAlbedo) / (albedo * albedo + Float(1e-4f)); }
};

inline void load_anywhere(const DenoiseLight& from, std::ptrdiff_t at, Float (&rgb)[3]) {
  for (int c = 0; c < 3; ++c) rgb[c] = load_anywhere(from.light[c] + at);
}

inline bool is_anything_seen(const DenoiseGuides& g, std::ptrdiff_t at) {
  return (Float::load(g.distance + at) < Float(kInfinity)).bits() != 0;
}

// Calls use(dx, dy) for the pixels around a pixel.
template <class Use>
[[gnu::always_inline]] inline void for_each_around(Use use) {
  for (int dy = -kDenoiseRadius; dy <= kDenoiseRadius; ++dy)
    for (int dx = -kDenoiseRadius; dx <= kDenoiseRadius; ++dx)
      if (dx != 0 || dy != 0) use(dx, dy);
}

void estimate(const DenoiseGuides& g, const DenoiseLight& from, bool spatial, int y, float* variance,
              const DenoiseContrast& contrast) {
  for (int x = 0; x < g.width; x += kWidth) {
    const std::ptrdiff_t at = y * g.stride + x;
    if (!is_anything_seen(g, at)) continue;  // nothing reads what is written there
    const Seen seen(g, at);
    const Float tolerance = seen.tolerance(1);
    Float rgb[3];
    load_anywhere(from, at, rgb);
    const Float middle = luminance(rgb);  // moments about it do not cancel
    Float weight(1.0f), squares(1.0f), first(0.0f), second(0.0f), variances = Float::load(from.variance + at);
    for_each_around([&](int dx, int dy) {
      const std::ptrdiff_t to = at + dy * g.stride + dx;
      const Float w = falloff(seen.off(g, to, dx, dy, tolerance));
      load_anywhere(from, to, rgb);
      const Float l = luminance(rgb) - middle;
      weight = weight + w;
      squares = squares + w * w;
      first = first + w * l;
      second = second + w * l * l;
      variances = variances + w * load_anywhere(from.variance + to);
    });
    const Float mean = first / weight, among = max(second / weight - mean * mean, Float(0.0f));
    const Float all = spatial ? among : variances / weight;
    all.store(variance + at);
    (middle + mean).store(contrast.luminance + at);
    (all * squares / (weight * weight)).store(contrast.variance + at);
  }
}

// Luminance and variance of pixels.
struct Contrast {
  Float luminance, variance;
};

// kFound: `contrast` has them.
template <bool kFound>
inline Contrast contrast_at(const DenoiseLight& from, const DenoiseContrast* contrast, const Float (&rgb)[3],
                            std::ptrdiff_t at) {
  if constexpr (kFound)
    return {load_anywhere(contrast->luminance + at), load_anywhere(contrast->variance + at)};
  return {luminance(rgb), load_anywhere(from.variance + at)};
}

template <bool kFound>
void filter_by(const DenoiseGuides& g, const DenoiseLight& from, const DenoiseContrast* contrast,
               const DenoiseLight& to, int step, int y) {
  constexpr float kMiddle = kSpline[kDenoiseRadius] * kSpline[kDenoiseRadius];
  for (int x = 0; x < g.width; x += kWidth) {
    const std::ptrdiff_t at = y * g.stride + x;
    if (!is_anything_seen(g, at)) continue;  // nothing reads what is written there
    const Seen seen(g, at);
    const Float tolerance = seen.tolerance(step);
    Float sum[3], rgb[3];
    load_anywhere(from, at, sum);
    const Contrast here = contrast_at<kFound>(from, contrast, sum, at);
    const Float least = Float(kSmallestContrast) * here.luminance * here.luminance + Float(1e-12f);
    Float weight(kMiddle), variance = load_anywhere(from.variance + at) * Float(kMiddle * kMiddle);
    for (Float& channel : sum) channel = channel * Float(kMiddle);
    for_each_around([&](int dx, int dy) {
      const std::ptrdiff_t there = at + dy * step * g.stride + dx * step;
      load_anywhere(from, there, rgb);
      const Contrast other = contrast_at<kFound>(from, contrast, rgb, there);
      const Float dl = other.luminance - here.luminance;
      const Float off = seen.off(g, there, dx * step, dy * step, tolerance) +
                        dl * dl / (Float(g.of_luminance) * (here.variance + other.variance) + least);
      const Float w = falloff(off) * Float(kSpline[dx + kDenoiseRadius] * kSpline[dy + kDenoiseRadius]);
      for (int c = 0; c < 3; ++c) sum[c] = sum[c] + w * rgb[c];
      weight = weight + w;
      variance = variance + w * w * load_anywhere(from.variance + there);
    });
    const Float all = Float(1.0f) / weight;
    for (int c = 0; c < 3; ++c) (sum[c] * all).store(to.light[c] + at);
    (variance * all * all).store(to.variance + at);
  }
}

void filter(const DenoiseGuides& g, const DenoiseLight& from, const DenoiseContrast* contrast,
            const DenoiseLight& to, int step, int y) {
  contrast ? filter_by<true>(g, from, contrast, to, step, y)
           : filter_by<false>(g, from, nullptr, to, step, y);
}

}  // namespace

extern const DenoiseSteps kDenoiseSteps;
const DenoiseSteps kDenoiseSteps{estimate, filter};

}  // namespace pinocchio::PINOCCHIO_LANES
