#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "core/output/aovs.h"
#include "core/trace/aov.h"
#include "pinocchio/camera.h"
#include "pinocchio/exr.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A frame as its EXR describes it; all images have the size of `part`.
struct FrameOutput {
  glm::ivec2 size{0, 0};  // of the whole picture, pixels
  PixelBox part;          // of it that was drawn
  const Scene& scene;
  const Camera& camera;
  const Image<glm::vec4>& color;
  const Image<std::uint32_t>& ids;
  const MaskImage& mask;                                  // 0 bits: no light casts
  const Image<glm::vec3>& reflection;                     // empty: none
  std::function<SurfaceImages(int y0, int y1)> surfaces;  // of these lines; any thread
  std::string plan_json;
  std::optional<double> render_s;
  int samples_per_pixel = 1;
  int frame = 0;  // of the animation
  int frames_per_second = 24;
  std::optional<double> time_s{};  // of the animation; else frame / frames_per_second
  int age_frames = 0;    // reprojected: how much older the mask and reflection are that the picture shows
  std::string inputs{};  // what else it was made of, if its maker says
};

// As many layers as asked for, with the values of lines [y0, y1).
[[nodiscard]] std::vector<ExrChannel> frame_channels(const FrameOutput& frame, const AovSet& aovs, int y0,
                                                     int y1);
// The frame's attributes and these channels.
[[nodiscard]] ExrFile frame_exr(const FrameOutput& frame, const AovSet& aovs, int y0, int y1);

// World to OpenEXR's camera space: left-handed, x right, y up, looking along +z. Column vectors.
[[nodiscard]] glm::mat4 world_to_camera(const Camera& camera);
// World to x and y in [0, 1] across the picture, y down, after division by w = z_eye; z is z_near / z_eye
// of an infinite view, 1 at z_eye = 1, 0 at infinity.
[[nodiscard]] glm::mat4 world_to_ndc(const Camera& camera, glm::ivec2 size);
// For each mask slot: the light's name, kind, world position or direction, colour and intensity; likewise of
// the lights that cast no shadow.
[[nodiscard]] std::string lights_json(const Scene& scene);
[[nodiscard]] std::string unshadowed_lights_json(const Scene& scene);

}  // namespace pinocchio
