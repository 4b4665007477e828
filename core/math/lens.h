// OpenCV's models of lenses. Source: the functions projectPoints and fisheye::projectPoints of OpenCV 4,
// module calib3d, as its documentation gives their formulas.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace pinocchio {

using LensCoefficients = std::array<float, 8>;

// The place where a lens with k1, k2, p1, p2, k3, k4, k5, k6 shows what a pinhole shows at `at`; both are
// x / z and y / z.
[[nodiscard]] glm::dvec2 distorted(const LensCoefficients& k, glm::dvec2 at);
// The inverse. None: the lens shows nothing there, or its model has stopped growing with the angle.
[[nodiscard]] std::optional<glm::dvec2> undistorted(const LensCoefficients& k, glm::dvec2 at);

// The distance from the axis at which a fisheye with k1, k2, k3, k4 shows the angle from the axis, radians.
[[nodiscard]] double fisheye_distance(const LensCoefficients& k, double angle);
// The inverse. None: as above, or the angle would exceed 180 degrees.
[[nodiscard]] std::optional<double> fisheye_angle(const LensCoefficients& k, double distance);

}  // namespace pinocchio
