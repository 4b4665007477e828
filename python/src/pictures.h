// What Python says about the pictures that an Engine draws: cameras, rays, poses, and where motion leads.
#pragma once

#include <pinocchio/batch.h>

#include <nanobind/stl/variant.h>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "python/src/scene/scene.h"

namespace pinocchio::python {

// A camera, or the index or name of one of the scene's. Nothing: the first, or one that sees the whole scene.
using CameraChoice = std::variant<std::monostate, Camera, int, std::string>;
[[nodiscard]] Camera camera_of(const Scene& scene, const CameraChoice& choice);

// The scene with a light: as in the program, one without lights gets one.
[[nodiscard]] Scene lit(const Scene& scene, const Camera& camera);

// Sets the rays of a picture: (origins, directions), each (h, w, 3), or (n, 3) for a picture of one row. One
// origin serves for all.
void set_rays(const nb::object& given, View& view);

// The frames that motion leads to, one for each camera: the other scene and the other cameras that are given,
// else the picture's own.
[[nodiscard]] std::vector<MotionTo> motions(const Scene& scene, const std::vector<Camera>& cameras,
                                            const PyScene* other,
                                            const std::optional<std::vector<CameraChoice>>& choices);

// Pictures of poses, with the moves that they refer to.
struct Poses {
  std::vector<std::vector<NodeTransform>> moves;  // of different poses
  std::vector<PosedPicture> pictures;
};

// A camera for each pose, or one for all. A camera of the scene moves with its node.
[[nodiscard]] Poses poses_of(const Scene& scene, const std::vector<CameraChoice>& choices,
                             const std::vector<Dict>& given);

}  // namespace pinocchio::python
