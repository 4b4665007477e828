#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/image/tonemap.h"

namespace pinocchio {

// The distribution of a picture's light over its pixels. Light is stored as half floats, so it is counted
// exactly, with one bin for each value.
class LightHistogram {
 public:
  // A pixel's values, as half floats.
  struct Sample {
    std::uint16_t luminance, brightest;  // brightest: the largest channel
  };
  explicit LightHistogram(std::span<const Sample> pixels);

  [[nodiscard]] std::size_t pixels() const { return pixels_; }
  // Numbers of pixels by luminance, in `bins` of equal width from lo to hi (log2 of linear light). Darker and
  // brighter pixels are in the first and the last bin.
  [[nodiscard]] std::vector<float> by_luminance(float lo_stops, float hi_stops, int bins) const;
  // The pixels with a channel that a display shows as 255, and those with all channels shown as 0.
  [[nodiscard]] std::size_t shown_white(float exposure_ev, ToneMap curve) const;
  [[nodiscard]] std::size_t shown_black(float exposure_ev, ToneMap curve) const;

 private:
  [[nodiscard]] std::size_t first_shown_as(std::uint8_t value, float exposure_ev, ToneMap curve) const;

  // Indexed by the bits of a half float, which have the order of the values. Infinity is the last. Negative
  // values and NaN count as 0.
  std::vector<std::uint32_t> luminance_, brightest_;
  std::size_t pixels_;
};

}  // namespace pinocchio
