// How far numbers are from reference numbers.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace pinocchio {

// Of finite values; `b` is the reference throughout.
struct ErrorFigures {
  double rmse = 0.0;
  double relative_mse = 0.0;    // mean of (a - b)^2 / (b^2 + 0.01)
  double psnr_db = 0.0;         // peak 1, of the values clamped to [0, 1]; +inf where those are equal
  double max_difference = 0.0;  // largest |a - b|
};

// Over pixels and RGB; a, b: as many, finite.
[[nodiscard]] ErrorFigures error_figures(std::span<const glm::vec3> a, std::span<const glm::vec3> b);

struct ChannelFigures {
  bool integers = false;
  std::uint64_t differing = 0;   // pixels that are not equal; two NaNs, two equal infinities are
  std::uint64_t not_finite = 0;  // of those, the pixels where one value is not finite; left out below
  std::uint64_t pixels = 0;
  ErrorFigures errors;  // not of integers
};

[[nodiscard]] ChannelFigures channel_figures(std::span<const float> a, std::span<const float> b);
// Of ids and masks a difference says nothing, only that there is one: `errors` stays 0.
[[nodiscard]] ChannelFigures channel_figures(std::span<const std::uint32_t> a,
                                             std::span<const std::uint32_t> b);

struct MaskFigures {
  int slots = 0;           // bits compared a pixel, from bit 0
  std::uint64_t bits = 0;  // compared in all
  std::uint64_t differing = 0;

  [[nodiscard]] double share() const {
    return bits == 0 ? 0.0 : static_cast<double>(differing) / static_cast<double>(bits);
  }
};

// Shadow masks, over pixels where a triangle is seen in either (empty ids: over all). Compares bits
// [0, named_slots), and up to the highest bit set anywhere.
struct MaskedPixels {
  std::span<const std::uint32_t> mask, ids;
};
[[nodiscard]] MaskFigures mask_figures(const MaskedPixels& a, const MaskedPixels& b, int named_slots);

}  // namespace pinocchio
