#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/math/bounds.h"
#include "core/scene/camera.h"
#include "core/scene/light.h"
#include "core/scene/material.h"

namespace pinocchio {

// RGBA, 8 bits a channel; colour is sRGB as the file stores it, alpha linear. Row 0 is the top row.
struct Texture {
  std::string name;
  Image<glm::u8vec4> texels;
};

// One soup of indexed triangles in world space. A triangle's index here is its id everywhere: in the
// GPU's visibility buffer, in every Hit and in the EXR.
struct Scene {
  std::string source;                     // path it was loaded from
  std::vector<std::string> source_files;  // that path and all files it names, also those that are missing

  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // one a position; a zero vector asks for the triangle's own (flat) normal
  std::vector<glm::vec2> texcoords;  // one a position, or empty where nothing is textured; v grows downwards
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> triangle_materials;  // one a triangle

  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  glm::vec3 ambient_light{0.1f};  // Ia; no file format we read carries it

  [[nodiscard]] Bounds bounds() const {
    Bounds b;
    for (const glm::uvec3& t : triangles)
      for (int i = 0; i < 3; ++i) b.add(positions[t[i]]);
    return b;
  }
  [[nodiscard]] const Material& material_of(std::uint32_t triangle) const {
    return materials[triangle_materials[triangle]];
  }
};

// Indices in scene.lights of the lights that cast shadows; position in the result is the mask slot.
[[nodiscard]] std::vector<int> casting_lights(const Scene& scene);

// The other way round: each light's mask slot, -1 where it does not cast.
[[nodiscard]] std::vector<int> mask_slots(const Scene& scene);

// Whether any of the box may be lit by it. False only where surely none is: no radiance, out of range, or
// outside the spot's cone.
[[nodiscard]] bool reaches(const Light& light, const Bounds& box);

// Lights that reach nothing cast nothing: no mask slot is spent on them.
void drop_idle_casters(Scene& scene);

// First camera named `name`, else nullptr.
[[nodiscard]] const Camera* find_camera(const Scene& scene, const std::string& name);

// A camera that has the whole scene in view, from slightly above and to the side.
[[nodiscard]] Camera camera_for_whole_scene(const Scene& scene);

// The light a scene without lights gets: a casting point light above and beside the camera's eye.
[[nodiscard]] Light default_light(const Scene& scene, const Camera& camera);

// Exact upper limits of what the renderer can draw; above them loading is an error that says so.
inline constexpr std::size_t kMaxTriangles = 0x3fffffffu;

}  // namespace pinocchio
