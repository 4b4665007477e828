// The first picture of a file that brings no camera or no light.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "pinocchio/scene.h"

namespace pinocchio {

// A camera on the front quarter (+Z, as glTF defines it), somewhat above. The silhouette of what the file
// shows fills 85 % of the shorter side of a picture of `size` pixels. Grounds and skies around it are left
// out of account: flat parts below that reach beyond the rest, and large parts around the rest that face it.
[[nodiscard]] Camera studio_camera(const Scene& scene, glm::ivec2 size);
// A studio_camera for a turntable. Its target is on the vertical axis through the object's middle. When the
// eye turns around the target, the object stays in the picture.
[[nodiscard]] Camera studio_turntable(const Scene& scene, glm::ivec2 size);

// Lights a scene that has no light: a soft, neutral sky and a directional light that casts, from the left of
// a studio_camera.
void add_studio_light(Scene& scene);
// True: the scene has the sky and the light of add_studio_light, and no other light.
[[nodiscard]] bool has_studio_light(const Scene& scene);
// True: the scene's sky is studio_sky().
[[nodiscard]] bool has_studio_sky(const Scene& scene);

// The studio's sky: neutral, darker below the horizon, with soft boxes above. Always the same one.
[[nodiscard]] std::shared_ptr<const Environment> studio_sky();

// Samples a pixel that make a picture in the studio smooth.
inline constexpr int kStudioSamples = 4;

}  // namespace pinocchio
