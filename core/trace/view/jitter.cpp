#include "core/trace/view/jitter.h"

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

// Point k of an additive recurrence (Roberts 2018) in the square from -0.5 to 0.5, evenly spread at any
// length. Point 0 is the middle, and points k and -k lie opposite each other.
glm::dvec2 even_point(int k, const glm::dvec2& step) {
  return glm::fract(0.5 + as_double(k) * step) - 0.5;
}

// Points of the recurrence in pairs that lie opposite each other, so that an even number of them has the
// middle as its mean; `first`: the first pair's.
glm::dvec2 paired_point(int k, int first, const glm::dvec2& step) {
  const glm::dvec2 at = even_point(first + k / 2, step);
  return k % 2 == 0 ? at : -at;
}

// Samples 1 to 15 of the box, found by search: with 4, 8, 10, 12, 14 and 16 samples the least error (root
// mean square) of the share that an edge covers, at all angles and places, and of waves across the pixel.
constexpr glm::dvec2 kFirst[] = {{-0.406, -0.097}, {0.311, -0.309},  {0.095, 0.406},  {-0.340, 0.326},
                                 {0.391, 0.228},   {-0.226, -0.390}, {0.175, -0.164}, {-0.061, -0.217},
                                 {0.061, 0.217},   {-0.408, 0.157},  {0.408, -0.157}, {-0.360, -0.346},
                                 {0.360, 0.346},   {-0.145, 0.350},  {0.145, -0.350}};
constexpr int kFound = std::ssize(kFirst);
constexpr int kFirstPair = 5;  // the best of those that were tried, for 20 to 256 samples

// Sample k > 0 of the box.
glm::dvec2 place_in_box(int k) {
  if (k <= kFound) return kFirst[k - 1];
  return paired_point(k - kFound - 1, kFirstPair, {0.75487766624669276, 0.56984029099805327});
}

glm::dvec2 place_in_window(int k) {
  const glm::dvec2 at = place_in_box(k) + 0.5;
  return {place_of_share(at.x), place_of_share(at.y)};
}

glm::dvec2 mean_in_window(int first, int end) {
  glm::dvec2 sum(0.0);
  for (int i = first; i < end; ++i) sum += place_in_window(i);
  return sum / as_double(end - first);
}

}  // namespace

glm::vec2 jitter_of(int k, PixelFilter filter) {
  if (k == 0) return glm::vec2(0.0f);
  if (filter == PixelFilter::box) return glm::vec2(place_in_box(k));
  glm::dvec2 at = place_in_window(k);
  // Samples 1 to 3 and 4 to 7 are not pairs: without their mean they stay about the centre.
  if (k < 4)
    at -= mean_in_window(1, 4);
  else if (k < 8)
    at -= mean_in_window(4, 8);
  return glm::vec2(at);
}

glm::vec2 lens_point_of(int k) {
  constexpr glm::dvec2 kStep(0.81917251339616444, 0.67104360670378927);
  const auto on_disc = [](const glm::dvec2& at) { return shared::disc_of_square(glm::vec2(at + 0.5)); };
  if (k == 0) return glm::vec2(0.0f);
  if (k >= 4) return on_disc(paired_point(k - 4, 4, kStep));
  glm::vec2 mean(0.0f);
  for (int i = 1; i < 4; ++i) mean += on_disc(even_point(i, kStep)) / 3.0f;
  return on_disc(even_point(k, kStep)) - mean;
}

View at_sample(View view, int k, PixelFilter filter) {
  view.jitter = jitter_of(k, filter);
  view.sample = k;
  return view;
}

}  // namespace pinocchio
