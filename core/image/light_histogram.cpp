#include "core/image/light_histogram.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <ranges>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::size_t kInfiniteHalf = 0x7c00, kHalves = kInfiniteHalf + 1;

std::size_t bin_of_half(std::uint16_t half) {
  return half <= kInfiniteHalf ? half : 0;
}

float value_of_half(std::size_t half) {
  return glm::unpackHalf1x16(static_cast<std::uint16_t>(half));
}

}  // namespace

LightHistogram::LightHistogram(std::span<const Sample> pixels)
    : luminance_(kHalves), brightest_(kHalves), pixels_(pixels.size()) {
  for (const Sample& pixel : pixels) {
    ++luminance_[bin_of_half(pixel.luminance)];
    ++brightest_[bin_of_half(pixel.brightest)];
  }
}

std::vector<float> LightHistogram::by_luminance(float lo_stops, float hi_stops, int bins) const {
  std::vector<float> counts(as_size(bins));
  for (std::size_t half = 0; half < kHalves; ++half) {
    if (luminance_[half] == 0) continue;
    const float at = (std::log2(value_of_half(half)) - lo_stops) / (hi_stops - lo_stops) * bins;
    counts[as_size(std::clamp(at, 0.0f, as_float(bins - 1)))] += luminance_[half];
  }
  return counts;
}

// Exposure, curve and sRGB are monotonic: from one value on, all are shown as bright or brighter.
std::size_t LightHistogram::first_shown_as(std::uint8_t value, float exposure_ev, ToneMap curve) const {
  const float gain = std::exp2(exposure_ev);
  const auto darker = [&](std::size_t half) {
    return linear_to_srgb8(tone_mapped(glm::vec3(gain * value_of_half(half)), curve).x) < value;
  };
  const auto halves = std::views::iota(std::size_t{0}, kHalves);
  return as_size(std::ranges::partition_point(halves, darker) - halves.begin());
}

std::size_t LightHistogram::shown_white(float exposure_ev, ToneMap curve) const {
  const auto first = static_cast<std::ptrdiff_t>(first_shown_as(255, exposure_ev, curve));
  return std::accumulate(brightest_.begin() + first, brightest_.end(), std::size_t{0});
}

std::size_t LightHistogram::shown_black(float exposure_ev, ToneMap curve) const {
  const auto first = static_cast<std::ptrdiff_t>(first_shown_as(1, exposure_ev, curve));
  return std::accumulate(brightest_.begin(), brightest_.begin() + first, std::size_t{0});
}

}  // namespace pinocchio
