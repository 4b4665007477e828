#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pinocchio/bounds.h"
#include "pinocchio/camera.h"
#include "pinocchio/environment.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/light.h"
#include "pinocchio/mesh.h"
#include "pinocchio/nodes.h"
#include "pinocchio/sampled_light.h"

namespace pinocchio {

struct Animation;

// Cheap to copy: copies share the mesh, so that moving a light copies no geometry. Lengths are in the file's
// units ("scene units"), colours are linear.
struct Scene {
  Scene() = default;
  explicit Scene(MeshData data) : mesh(std::make_shared<const Mesh>(std::move(data))) {}

  std::shared_ptr<const Mesh> mesh = std::make_shared<const Mesh>();  // never null
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  glm::vec3 ambient_light{0.1f};                   // Ia; glTF: the scene's extras.pinocchio.ambient
  std::shared_ptr<const Environment> environment;  // light where no triangle is; null: black
  float environment_rotation_deg = 0.0f;           // about +Y
  float environment_strength = 1.0f;               // multiplies the environment's light
  std::shared_ptr<const NodeTree> nodes;           // the parts that can move; null: none
  std::shared_ptr<const Animation> animation;      // of the nodes (pinocchio/animation.h); null: none

  std::vector<std::string> variants;      // names of the file's variants of its materials (LoadOptions)
  std::string source;                     // the file's path
  std::vector<std::string> source_files;  // that path and all files that it names, also missing ones

  // Whether they look the same from anywhere.
  friend bool operator==(const Scene& a, const Scene& b) {
    return a.mesh == b.mesh && a.lights == b.lights && a.ambient_light == b.ambient_light &&
           a.environment == b.environment && a.environment_rotation_deg == b.environment_rotation_deg &&
           a.environment_strength == b.environment_strength;
  }
};

// Indices in scene.lights of the lights that cast shadows. The position in the result is the mask slot.
[[nodiscard]] std::vector<int> casting_lights(const Scene& scene);

// The inverse: each light's mask slot, -1 for a light that does not cast.
[[nodiscard]] std::vector<int> mask_slots(const Scene& scene);

// Whether the light may reach a part of the box. False only if it certainly does not: no radiance, out of
// range, or outside the spot's cone.
[[nodiscard]] bool reaches(const Light& light, const Bounds& box);

// Lights that reach nothing do not cast, so that they take no mask slot.
void drop_idle_casters(Scene& scene);

// Whether a picture of the scene by these methods needs many samples: the scene has lights with a size,
// glossy mirrors or an environment.
[[nodiscard]] bool takes_samples(const Scene& scene, EnvironmentMethod sky = EnvironmentMethod::sampled,
                                 Glossy glossy = Glossy::sampled);

// The first camera named `name`; null: none.
[[nodiscard]] const Camera* find_camera(const Scene& scene, const std::string& name);

// A camera that sees the whole scene, from slightly above and to the side.
[[nodiscard]] Camera camera_for_whole_scene(const Scene& scene);

// The light of a scene without lights: a casting point light above and beside the camera's eye.
[[nodiscard]] Light default_light(const Scene& scene, const Camera& camera);

// The exact limits of the renderer. Loading a larger scene is an error that names the limit.
inline constexpr std::size_t kMaxTriangles = 0x3fffffffu;

}  // namespace pinocchio
