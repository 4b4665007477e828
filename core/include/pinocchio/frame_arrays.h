#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// Where pictures are written: arrays of the caller's, frame after frame, row after row from the top, with a
// value a pixel. Null: not wanted, and nothing is traced for it. All are of the first sample but `color`.
struct FrameArrays {
  glm::vec4* color = nullptr;        // linear RGBA, mean of the samples; A: how much of the pixel is covered
  float* depth = nullptr;            // along the view axis, scene units; +inf where nothing is hit
  glm::vec3* position = nullptr;     // world; 0 where nothing is hit, as the next two
  glm::vec3* normal = nullptr;       // world, unit
  glm::vec3* albedo = nullptr;       // diffuse colour, linear
  std::uint32_t* ids = nullptr;      // triangles, kNoTriangle where nothing is hit
  std::uint32_t* objects = nullptr;  // nodes (pinocchio/nodes.h), likewise; 0 where the scene has none
  std::uint8_t* mask = nullptr;      // bit i: the light in mask slot i reaches the point
  glm::vec3* reflection = nullptr;   // mirrored and refracted light, linear

  [[nodiscard]] bool wants_light() const { return color || mask || reflection; }
  [[nodiscard]] bool wants_surfaces() const { return depth || position || normal || albedo; }
};

}  // namespace pinocchio
