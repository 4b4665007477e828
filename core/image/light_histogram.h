#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/image/tonemap.h"

namespace pinocchio {

// How a picture's light is spread over its pixels. Light is kept as half floats, and so is counted exactly:
// one bin for each value that there is.
class LightHistogram {
 public:
  // Of one pixel, as half floats.
  struct Sample {
    std::uint16_t luminance, brightest;  // brightest: of its channels
  };
  explicit LightHistogram(std::span<const Sample> pixels);

  [[nodiscard]] std::size_t pixels() const { return pixels_; }
  // Pixels by their luminance, in `bins` of equal width from lo to hi (log2 of linear light): what is darker
  // or brighter is in the first or the last one.
  [[nodiscard]] std::vector<float> by_luminance(float lo_stops, float hi_stops, int bins) const;
  // Pixels with a channel that a display shows as 255, and those whose channels are all shown as 0.
  [[nodiscard]] std::size_t shown_white(float exposure_ev, ToneMap curve) const;
  [[nodiscard]] std::size_t shown_black(float exposure_ev, ToneMap curve) const;

 private:
  [[nodiscard]] std::size_t first_shown_as(std::uint8_t value, float exposure_ev, ToneMap curve) const;

  // By the bits of a half float, which are in the order of its values. Infinity is the last; what is negative
  // or no number counts as 0.
  std::vector<std::uint32_t> luminance_, brightest_;
  std::size_t pixels_;
};

}  // namespace pinocchio
