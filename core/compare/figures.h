// Differences between values and reference values.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pinocchio/conversion.h"

namespace pinocchio {

// Errors of finite values. `b` is the reference in all of these.
struct ErrorFigures {
  double rmse = 0.0;
  double relative_mse = 0.0;    // mean of (a - b)^2 / (b^2 + 0.01)
  double psnr_db = 0.0;         // of the values clamped to [0, 1], peak 1; +inf if they are equal
  double max_difference = 0.0;  // largest |a - b|
};

// Over pixels and RGB. a, b: the same number, finite.
[[nodiscard]] ErrorFigures error_figures(std::span<const glm::vec3> a, std::span<const glm::vec3> b);

struct ChannelFigures {
  bool integers = false;
  std::uint64_t differing = 0;   // unequal pixels; two NaNs or two equal infinities count as equal
  std::uint64_t not_finite = 0;  // unequal pixels with a value that is not finite; not in `errors`
  std::uint64_t pixels = 0;
  ErrorFigures errors;  // 0 for integers
};

[[nodiscard]] ChannelFigures channel_figures(std::span<const float> a, std::span<const float> b);
// For ids and masks, where the size of a difference means nothing: `errors` stays 0.
[[nodiscard]] ChannelFigures channel_figures(std::span<const std::uint32_t> a,
                                             std::span<const std::uint32_t> b);

struct MaskFigures {
  int slots = 0;           // compared bits of each pixel, from bit 0
  std::uint64_t bits = 0;  // compared bits in all
  std::uint64_t differing = 0;

  [[nodiscard]] double share() const { return bits == 0 ? 0.0 : as_double(differing) / as_double(bits); }
};

// Compares shadow masks over the pixels where either picture shows a triangle (empty ids: over all pixels):
// bits [0, named_slots), and more up to the highest bit that is set.
struct MaskedPixels {
  std::vector<std::span<const std::uint32_t>> mask;  // 32 slots each; what one picture lacks is 0
  std::span<const std::uint32_t> ids;
};
[[nodiscard]] MaskFigures mask_figures(const MaskedPixels& a, const MaskedPixels& b, int named_slots);

}  // namespace pinocchio
