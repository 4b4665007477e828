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

namespace pinocchio {

struct Animation;

// A cheap value: copies share the mesh, so that moving a light copies no geometry. Lengths are in the file's
// units ("scene units"), colours linear.
struct Scene {
  Scene() = default;
  explicit Scene(MeshData data) : mesh(std::make_shared<const Mesh>(std::move(data))) {}

  std::shared_ptr<const Mesh> mesh = std::make_shared<const Mesh>();  // never null
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  glm::vec3 ambient_light{0.1f};                   // Ia; no file format we read carries it
  std::shared_ptr<const Environment> environment;  // seen where no triangle is, and shines; null: black
  float environment_rotation_deg = 0.0f;           // how far it is turned about +Y
  float environment_strength = 1.0f;               // multiplies its light
  std::shared_ptr<const NodeTree> nodes;           // of what can be moved; null: nothing can
  std::shared_ptr<const Animation> animation;      // of the nodes (pinocchio/animation.h); null: none

  std::string source;                     // path it was loaded from
  std::vector<std::string> source_files;  // that path and all files it names, also those that are missing

  // Whether they look the same, from anywhere.
  friend bool operator==(const Scene& a, const Scene& b) {
    return a.mesh == b.mesh && a.lights == b.lights && a.ambient_light == b.ambient_light &&
           a.environment == b.environment && a.environment_rotation_deg == b.environment_rotation_deg &&
           a.environment_strength == b.environment_strength;
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

// Whether one picture of it is one sample of many: of lights with a size, of glossy mirrors, of an
// environment.
[[nodiscard]] bool takes_samples(const Scene& scene);

// First camera named `name`, else nullptr.
[[nodiscard]] const Camera* find_camera(const Scene& scene, const std::string& name);

// A camera that has the whole scene in view, from slightly above and to the side.
[[nodiscard]] Camera camera_for_whole_scene(const Scene& scene);

// The light a scene without lights gets: a casting point light above and beside the camera's eye.
[[nodiscard]] Light default_light(const Scene& scene, const Camera& camera);

// Exact upper limits of what the renderer can draw; above them loading is an error that says so.
inline constexpr std::size_t kMaxTriangles = 0x3fffffffu;

}  // namespace pinocchio
