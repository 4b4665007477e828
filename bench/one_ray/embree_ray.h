#pragma once

#include <embree3/rtcore.h>

#include "pinocchio/ray.h"

namespace pinocchio {

// A ray at time 0 with all mask bits.
[[nodiscard]] inline RTCRay to_embree(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tfar = ray.t_max;
  r.mask = 0xffffffffu;
  return r;
}

}  // namespace pinocchio
