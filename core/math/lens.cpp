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

// Newton's method, with shorter steps where a whole one leads away.
std::optional<glm::dvec2> undistorted(const LensCoefficients& k, glm::dvec2 at) {
  glm::dvec2 found = at, error = distorted(k, found) - at;
  for (int i = 0; i < kMostSteps && glm::length(error) > kExact * (1.0 + glm::length(at)); ++i) {
    const glm::dmat2 change = change_of(k, found);
    if (!(std::abs(glm::determinant(change)) > 1e-12)) return std::nullopt;
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

double fisheye_distance(const LensCoefficients& k, double angle) {
  const double a2 = angle * angle;
  return angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
}

std::optional<double> fisheye_angle(const LensCoefficients& k, double distance) {
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

}  // namespace pinocchio
