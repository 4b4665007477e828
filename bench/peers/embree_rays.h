// Embree, as its tutorials use it: a scene of triangles, one ray at a time.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <glm/glm.hpp>

#include "pinocchio/mesh.h"

namespace pinocchio {

[[nodiscard]] inline RTCScene embree_scene_of(RTCDevice device, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
  std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
  auto* const triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

[[nodiscard]] inline RTCRayHit embree_ray(const glm::vec3& p, const glm::vec3& d, float t_far) {
  RTCRayHit ray{};
  ray.ray.org_x = p.x, ray.ray.org_y = p.y, ray.ray.org_z = p.z;
  ray.ray.dir_x = d.x, ray.ray.dir_y = d.y, ray.ray.dir_z = d.z;
  ray.ray.tfar = t_far;
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}  // namespace pinocchio
