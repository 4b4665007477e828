#include "core/compare/figures.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "pinocchio/conversion.h"
#include "pinocchio/ray.h"

namespace pinocchio {
namespace {

// The sums that ErrorFigures are computed from.
class ErrorSums {
 public:
  void add(float a_value, float b_value) {
    const double a = a_value, b = b_value, d = a - b;
    const double clamped = std::clamp(a, 0.0, 1.0) - std::clamp(b, 0.0, 1.0);
    ++count_;
    squares_ += d * d;
    relative_ += d * d / (b * b + 0.01);
    clamped_squares_ += clamped * clamped;
    max_ = std::max(max_, std::abs(d));
  }

  [[nodiscard]] ErrorFigures figures() const {
    const double n = std::max(1.0, as_double(count_));
    const double psnr_db = clamped_squares_ > 0.0 ? -10.0 * std::log10(clamped_squares_ / n)
                                                  : std::numeric_limits<double>::infinity();
    return {std::sqrt(squares_ / n), relative_ / n, psnr_db, max_};
  }

 private:
  std::uint64_t count_ = 0;
  double squares_ = 0.0, relative_ = 0.0, clamped_squares_ = 0.0, max_ = 0.0;
};

}  // namespace

ErrorFigures error_figures(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
  assert(a.size() == b.size());
  ErrorSums sums;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) sums.add(a[i][c], b[i][c]);
  return sums.figures();
}

ChannelFigures channel_figures(std::span<const float> a, std::span<const float> b) {
  assert(a.size() == b.size());
  ChannelFigures figures;
  ErrorSums sums;
  figures.pixels = a.size();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool same = a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]));
    if (!same) ++figures.differing;
    if (std::isfinite(a[i]) && std::isfinite(b[i])) {
      sums.add(a[i], b[i]);
    } else if (!same) {
      ++figures.not_finite;
    }
  }
  figures.errors = sums.figures();
  return figures;
}

ChannelFigures channel_figures(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  assert(a.size() == b.size());
  ChannelFigures figures;
  figures.integers = true;
  figures.pixels = a.size();
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) ++figures.differing;
  return figures;
}

MaskFigures mask_figures(const MaskedPixels& a, const MaskedPixels& b, int named_slots) {
  assert(!a.mask.empty() && !b.mask.empty() && a.mask.front().size() == b.mask.front().size());
  const auto hit = [](const MaskedPixels& of, std::size_t i) {
    return of.ids.empty() || of.ids[i] != kNoTriangle;
  };
  const auto slots_of = [](const MaskedPixels& of, std::size_t word, std::size_t i) {
    return word < of.mask.size() ? of.mask[word][i] : 0u;
  };
  const std::size_t words = std::max(a.mask.size(), b.mask.size());
  MaskFigures figures;
  std::vector<std::uint32_t> set(words);
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < a.mask.front().size(); ++i) {
    if (!hit(a, i) && !hit(b, i)) continue;
    ++pixels;
    for (std::size_t word = 0; word < words; ++word) {
      const std::uint32_t of_a = slots_of(a, word, i), of_b = slots_of(b, word, i);
      set[word] |= of_a | of_b;
      figures.differing += std::popcount(of_a ^ of_b);
    }
  }
  figures.slots = std::clamp(named_slots, 0, 32 * as_int(words));
  for (int word = 0; const std::uint32_t bits : set) {
    if (bits != 0) figures.slots = std::max(figures.slots, 32 * word + as_int(std::bit_width(bits)));
    ++word;
  }
  figures.bits = pixels * figures.slots;
  return figures;
}

}  // namespace pinocchio
