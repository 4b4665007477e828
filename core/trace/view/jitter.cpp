#include "core/trace/view/jitter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/shade/shared.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Integral of the window of Blackman and Harris (1978), 3 pixels wide, from -1.5 to x.
double share_left_of(double x) {
  constexpr double kA0 = 0.35875, kA1 = 0.48829, kA2 = 0.14128, kA3 = 0.01168;
  const double t = x / 3.0 + 0.5, turn = 2.0 * std::numbers::pi;
  return t - (kA1 * std::sin(turn * t) - kA2 / 2.0 * std::sin(2.0 * turn * t) +
              kA3 / 3.0 * std::sin(3.0 * turn * t)) /
                 (turn * kA0);
}

// Inverse of share_left_of, by bisection.
double place_of_share(double share) {
  double lo = -1.5, hi = 1.5;
  while (hi - lo > 1e-7) {
    const double middle = 0.5 * (lo + hi);
    (share_left_of(middle) < share ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

// Point k of an additive recurrence (Roberts 2018), evenly spread at any length; the first is the middle.
glm::dvec2 even_point(int k, const glm::dvec2& step) {
  return glm::fract(0.5 + as_double(k) * step);
}

// Samples 1 to 15 of pictures whose noise is filtered, so that outlines are all of their error: the least
// mean squared error of the share that an edge covers, at all angles and places, of the first 4, 8 and 16.
constexpr glm::dvec2 kOfOutlines[] = {{-0.406, -0.097}, {0.311, -0.309},  {0.095, 0.406},  {-0.340, 0.326},
                                      {0.391, 0.228},   {-0.226, -0.390}, {0.175, -0.164}, {-0.438, 0.085},
                                      {-0.277, -0.287}, {-0.153, 0.444},  {0.022, -0.441}, {0.265, 0.003},
                                      {0.467, -0.209},  {-0.118, 0.133},  {0.232, 0.272}};

glm::dvec2 place_of(int k, PixelFilter filter, bool outlines = false) {
  glm::dvec2 at = even_point(k, {0.75487766624669276, 0.56984029099805327});
  if (outlines && k > 0 && k <= std::ssize(kOfOutlines)) at = kOfOutlines[k - 1] + 0.5;
  if (filter == PixelFilter::box || k == 0) return at - 0.5;
  return {place_of_share(at.x), place_of_share(at.y)};
}

// The mean of the samples from `first` to twice as far (of the first three, from 1 to 3). Frames ask it once
// a sample, one after another, so that a thread keeps the last one.
glm::dvec2 mean_from(int first, PixelFilter filter) {
  struct Mean {
    int first = 0;
    PixelFilter filter{};
    glm::dvec2 value{};
  };
  thread_local Mean last;
  if (last.first == first && last.filter == filter) return last.value;
  const int end = std::max(4, 2 * first);
  glm::dvec2 sum(0.0);
  for (int i = first; i < end; ++i) sum += place_of(i, filter, true);
  last = {first, filter, sum / as_double(end - first)};
  return last.value;
}

}  // namespace

glm::vec2 jitter_of(int k, PixelFilter filter) {
  return glm::vec2(place_of(k, filter));
}

glm::vec2 balanced_jitter_of(int k, PixelFilter filter) {
  if (k == 0) return glm::vec2(0.0f);
  const int first = k < 4 ? 1 : as_int(std::bit_floor(static_cast<unsigned>(k)));
  return glm::vec2(place_of(k, filter, true) - mean_from(first, filter));
}

glm::vec2 lens_point_of(int k) {
  if (k == 0) return glm::vec2(0.0f);
  return shared::disc_of_square(glm::vec2(even_point(k, {0.81917251339616444, 0.67104360670378927})));
}

View at_sample(View view, int k, PixelFilter filter, bool balanced) {
  view.jitter = balanced ? balanced_jitter_of(k, filter) : jitter_of(k, filter);
  view.sample = k;
  return view;
}

}  // namespace pinocchio
