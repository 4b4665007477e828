#include "core/math/lens.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr int kMostSteps = 50;
constexpr double kExact = 1e-13;  // of the inverse, relative
constexpr int kPartsOfWay = 16;   // at which the model is checked to grow
constexpr int kStepsOutwards = 16;

// The columns are the changes with x and y.
glm::dmat2 change_of(const LensCoefficients& c, glm::dvec2 at) {
  const double k1 = c[0], k2 = c[1], p1 = c[2], p2 = c[3], k3 = c[4], k4 = c[5], k5 = c[6], k6 = c[7];
  const double x = at.x, y = at.y, r2 = x * x + y * y;
  const double above = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3)), below = 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double above_by_r2 = k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3),
               below_by_r2 = k4 + r2 * (2.0 * k5 + r2 * 3.0 * k6);
  const double factor = above / below,
               factor_by_r2 = (above_by_r2 * below - above * below_by_r2) / (below * below);
  const double across = 2.0 * x * y * factor_by_r2 + 2.0 * p1 * x + 2.0 * p2 * y;
  return {{factor + 2.0 * x * x * factor_by_r2 + 2.0 * p1 * y + 6.0 * p2 * x, across},
          {across, factor + 2.0 * y * y * factor_by_r2 + 6.0 * p1 * y + 2.0 * p2 * x}};
}

// Whether the model grows all the way from the axis to `at`.
bool grows_up_to(const LensCoefficients& k, glm::dvec2 at) {
  for (int i = 1; i <= kPartsOfWay; ++i) {
    const glm::dmat2 change = change_of(k, (as_double(i) / kPartsOfWay) * at);
    if (!(glm::determinant(change) > 0.0 && change[0][0] + change[1][1] > 0.0)) return false;
  }
  return true;
}

double fisheye_change(const LensCoefficients& k, double angle) {
  const double a2 = angle * angle;
  return 1.0 + a2 * (3.0 * k[0] + a2 * (5.0 * k[1] + a2 * (7.0 * k[2] + a2 * 9.0 * k[3])));
}

}  // namespace

glm::dvec2 distorted(const LensCoefficients& c, glm::dvec2 at) {
  const double k1 = c[0], k2 = c[1], p1 = c[2], p2 = c[3], k3 = c[4], k4 = c[5], k5 = c[6], k6 = c[7];
  const double x = at.x, y = at.y, r2 = x * x + y * y;
  const double factor = (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  return {x * factor + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * factor + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

namespace {

// Newton's method from `found` on, with shorter steps where a whole one leads away.
std::optional<glm::dvec2> undistorted_from(const LensCoefficients& k, glm::dvec2 at, glm::dvec2 found) {
  glm::dvec2 error = distorted(k, found) - at;
  for (int i = 0; i < kMostSteps && glm::length(error) > kExact * (1.0 + glm::length(at)); ++i) {
    const glm::dmat2 change = change_of(k, found);
    if (!(glm::determinant(change) > 1e-12)) return std::nullopt;  // it has stopped growing
    glm::dvec2 step = glm::inverse(change) * error;
    for (int half = 0; half < 20; ++half, step *= 0.5)
      if (glm::length(distorted(k, found - step) - at) < glm::length(error)) break;
    found -= step;
    error = distorted(k, found) - at;
  }
  // The last digit may not be reached.
  if (!(glm::length(error) <= 1e3 * kExact * (1.0 + glm::length(at))) || !grows_up_to(k, found))
    return std::nullopt;
  return found;
}

}  // namespace

std::optional<glm::dvec2> undistorted(const LensCoefficients& k, glm::dvec2 at) {
  if (const auto found = undistorted_from(k, at, at)) return found;
  // `at` itself may lie beyond where the model grows: from the axis outwards, each place from the last.
  glm::dvec2 found(0.0);
  for (int i = 1; i <= kStepsOutwards; ++i) {
    const auto next = undistorted_from(k, (as_double(i) / kStepsOutwards) * at, found);
    if (!next) return std::nullopt;
    found = *next;
  }
  return found;
}

double fisheye_distance(const LensCoefficients& k, double angle) {
  const double a2 = angle * angle;
  return angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
}

namespace {

std::optional<double> fisheye_angle_by_newton(const LensCoefficients& k, double distance) {
  double angle = std::min(distance, glm::pi<double>());
  for (int i = 0; i < kMostSteps; ++i) {
    const double change = fisheye_change(k, angle);
    if (!(change > 1e-9)) return std::nullopt;
    const double step = (fisheye_distance(k, angle) - distance) / change;
    angle = std::max(angle - step, 0.0);
    if (std::abs(step) <= kExact * (1.0 + angle)) break;
  }
  if (!(std::abs(fisheye_distance(k, angle) - distance) <= 1e3 * kExact * (1.0 + distance)) ||
      angle > glm::pi<double>())
    return std::nullopt;
  for (int i = 1; i <= kPartsOfWay; ++i)
    if (!(fisheye_change(k, angle * i / kPartsOfWay) > 0.0)) return std::nullopt;
  return angle;
}

// The last place of [lo, hi] that is not above, by 60 halvings.
template <class Above>
double last_below(double lo, double hi, const Above& is_above) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lo + hi);
    (is_above(middle) ? hi : lo) = middle;
  }
  return lo;
}

}  // namespace

std::optional<double> fisheye_angle(const LensCoefficients& k, double distance) {
  if (const auto found = fisheye_angle_by_newton(k, distance)) return found;
  // From the axis outwards, up to where the model stops growing.
  constexpr int kParts = 64;
  double angle = 0.0;
  for (int i = 1; i <= kParts; ++i) {
    double next = glm::pi<double>() * i / kParts;
    const bool grows = fisheye_change(k, next) > 0.0;
    if (!grows) next = last_below(angle, next, [&](double a) { return !(fisheye_change(k, a) > 0.0); });
    if (fisheye_distance(k, next) >= distance)
      return last_below(angle, next, [&](double a) { return fisheye_distance(k, a) >= distance; });
    if (!grows) return std::nullopt;
    angle = next;
  }
  return std::nullopt;
}

}  // namespace pinocchio
