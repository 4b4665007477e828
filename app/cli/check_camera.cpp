#include "app/cli/check_camera.h"

#include <algorithm>
#include <cmath>

#include "app/cli/errors.h"
#include "pinocchio/load.h"

namespace pinocchio::app {

void check_camera(const Camera& camera, const std::string& whose) {
  const auto fail = [&](const std::string& what) { throw Exit(kUsage, whose + ": " + what); };
  const auto is_far = [](const glm::vec3& p) {
    return !(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthest);
  };
  if (is_far(camera.eye)) fail("its eye is more than 1e9 from the origin; move it nearer");
  if (is_far(camera.target)) fail("its target is more than 1e9 from the origin; move it nearer");
  if (camera.eye == camera.target) fail("its eye and its target are the same point; move one of them");
  if (!(glm::length(glm::dvec3(camera.up)) > 0.0) || is_far(camera.up))
    fail("its up is not a direction; give one such as 0,1,0");
  const bool is_fisheye = camera.projection == Projection::fisheye;
  if (!(camera.fov_deg > 0.0f && (is_fisheye ? camera.fov_deg <= kWidestFisheye : camera.fov_deg < 180.0f)))
    fail(is_fisheye ? "its field of view is not between 0 and 360 degrees"
                    : "its field of view is not between 0 and 180 degrees");
  if (!(camera.height > 0.0f && camera.height <= kFarthest))
    fail("its height is not above 0, or more than 1e9");
}

}  // namespace pinocchio::app
