#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "core/output/aovs.h"
#include "pinocchio/camera.h"
#include "pinocchio/exr.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A frame as its EXR describes it.
struct FrameOutput {
  glm::ivec2 size{0, 0};  // of the whole picture, pixels
  PixelBox part;          // the part that was drawn
  const Scene& scene;
  const Camera& camera;
  // Writes the lines [y0, y1) of the wanted layers, from their arrays' begin on. Any thread.
  std::function<void(int y0, int y1, const FrameArrays& to)> write_lines;
  std::string plan_json;
  std::optional<double> render_s;
  int samples_per_pixel = 1;
  int frame = 0;  // of the animation
  int frames_per_second = 24;
  std::optional<double> time_s{};  // of the animation; else frame / frames_per_second
  int age_frames = 0;              // reprojected: how much older the shown mask and reflection are
  bool has_rays = false;           // the caller gave the rays
  std::string inputs{};            // what else the picture was made of, where its maker says so
};

// The colour and the wanted layers, with the values of lines [y0, y1).
[[nodiscard]] std::vector<ExrChannel> frame_channels(const FrameOutput& frame, const AovSet& aovs, int y0,
                                                     int y1);
// The frame's attributes and frame_channels().
[[nodiscard]] ExrFile frame_exr(const FrameOutput& frame, const AovSet& aovs, int y0, int y1);

// World to OpenEXR's camera space: left-handed, x right, y up, looking along +z. Column vectors.
[[nodiscard]] glm::mat4 world_to_camera(const Camera& camera);
// World to x and y in [0, 1] across the picture, y down, after division by w = z_eye; z is z_near / z_eye
// of an infinite view, 1 at z_eye = 1, 0 at infinity. For an orthographic camera, w is 1 and z is z_eye.
// Other cameras have no such matrix.
[[nodiscard]] glm::mat4 world_to_ndc(const Camera& camera, glm::ivec2 size);
// The casting lights in mask-slot order, and the lights that cast no shadow: name, kind, world position or
// direction, colour and intensity of each.
[[nodiscard]] std::string lights_json(const Scene& scene);
[[nodiscard]] std::string unshadowed_lights_json(const Scene& scene);

}  // namespace pinocchio
