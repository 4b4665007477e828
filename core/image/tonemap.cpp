#include "core/image/tonemap.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pinocchio {
namespace shared {

using namespace glm;  // GLSL's names

#define SHARED [[nodiscard]] inline
#include "pinocchio/conversion.h"
#include "shaders/shared/tone_map.glsl"
#undef SHARED

}  // namespace shared

namespace {

// The curve's upper part in basic operations, because libraries differ in the last bits of x^y. c^2.4 is c^2
// times the fifth root of c^2, which Newton's method finds from above; c in (0, 1].
double power_2_4(double c) {
  const double square = c * c;
  double root = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double fourth = root * root * root * root;
    root -= (fourth * root - square) / (5.0 * fourth);
  }
  return square * root;
}

double srgb_to_linear(double c) {
  return c <= 0.04045 ? c / 12.92 : power_2_4((c + 0.055) / 1.055);
}

// A value's byte changes where the curve passes the middle between two bytes. `first[i]` is the least value
// of byte i.
struct SrgbBytes {
  std::array<float, 256> linear{};
  std::array<float, 257> first{};
  SrgbBytes() {
    first.back() = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < 256; ++i) {
      linear[i] = srgb_to_linear(i / 255.0);
      if (i == 0) continue;
      const double middle = srgb_to_linear((i - 0.5) / 255.0);
      first[i] = middle;
      if (first[i] < middle) first[i] = std::nextafter(first[i], 2.0f);
    }
    // The byte of the least value with the same exponent and nine digits. The others have this byte or the
    // next.
    for (std::size_t i = 0; i < start.size(); ++i) {
      const float least = std::bit_cast<float>(kLeast + (as_uint32(i) << kDropped));
      start[i] = std::upper_bound(first.begin(), first.end(), least) - first.begin() - 1;
    }
  }

  [[nodiscard]] std::uint8_t of(float value) const {
    return within(value > 0.0f ? std::min(value, 1.0f) : 0.0f);  // NaN is 0
  }

  [[nodiscard]] std::uint8_t within(float value) const {  // [0, 1]
    const std::uint32_t bits = std::max(std::bit_cast<std::uint32_t>(value), kLeast);
    const std::size_t byte = start[(bits - kLeast) >> kDropped];
    return byte + (value >= first[byte + 1] ? 1 : 0);
  }

 private:
  static constexpr std::uint32_t kLeast = 0x39000000u;                         // 2^-13: its byte is 0
  static constexpr int kDropped = 14;                                          // digits
  std::array<std::uint8_t, ((0x3f800000u - kLeast) >> kDropped) + 1> start{};  // up to 1
};

const SrgbBytes& bytes() {
  static const SrgbBytes kSrgbBytes;
  return kSrgbBytes;
}

}  // namespace

float srgb8_to_linear(std::uint8_t value) {
  return bytes().linear[value];
}

const std::array<float, 256>& linear_from_srgb8() {
  return bytes().linear;
}

glm::vec3 srgb_to_linear(const glm::vec3& srgb) {
  const auto channel = [](float c) {
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
  };
  return {channel(srgb.x), channel(srgb.y), channel(srgb.z)};
}

float linear_to_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

std::uint8_t linear_to_srgb8(float linear) {
  return bytes().of(linear);
}

void linear_to_srgb8(std::span<const glm::vec4> linear, glm::u8vec4* to) {
  const SrgbBytes& b = bytes();
  for (const glm::vec4& t : linear)
    *to++ = {b.within(t.r), b.within(t.g), b.within(t.b), static_cast<std::uint8_t>(t.a * 255.0f + 0.5f)};
}

glm::vec3 tone_mapped(const glm::vec3& light, ToneMap curve) {
  return shared::tone_mapped(light, as_int(curve));
}

Image<glm::u8vec3> preview(const Image<glm::vec4>& color, float exposure_ev, ToneMap curve,
                           const std::optional<glm::vec3>& behind) {
  const float gain = std::exp2(exposure_ev);
  const auto shown_light = [&](const glm::vec4& pixel) {
    if (!behind) return tone_mapped(gain * glm::vec3(pixel), curve);
    const float alpha = std::clamp(pixel.a, 0.0f, 1.0f);
    const glm::vec3 rest = (1.0f - alpha) * *behind;
    if (alpha == 0.0f) return rest;
    return rest + alpha * tone_mapped(gain / alpha * glm::max(glm::vec3(pixel) - rest, 0.0f), curve);
  };
  Image<glm::u8vec3> pixels(color.size());
  for (std::size_t i = 0; i < color.pixels().size(); ++i) {
    const glm::vec3 shown = shown_light(color[i]);
    for (int c = 0; c < 3; ++c) pixels[i][c] = linear_to_srgb8(shown[c]);
  }
  return pixels;
}

Image<glm::u8vec4> preview_with_alpha(const Image<glm::vec4>& color, float exposure_ev, ToneMap curve) {
  const float gain = std::exp2(exposure_ev);
  Image<glm::u8vec4> pixels(color.size());
  for (std::size_t i = 0; i < color.pixels().size(); ++i) {
    const float alpha = std::clamp(color[i].a, 0.0f, 1.0f);
    if (alpha <= 0.0f) continue;  // 0, 0, 0, 0
    const glm::vec3 shown = tone_mapped(gain / alpha * glm::vec3(color[i]), curve);
    for (int c = 0; c < 3; ++c) pixels[i][c] = linear_to_srgb8(shown[c]);
    pixels[i].a = static_cast<std::uint8_t>(255.0f * alpha + 0.5f);
  }
  return pixels;
}

}  // namespace pinocchio
