#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pinocchio/scene.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// The facts of a scene that settings are resolved by.
struct SceneStats {
  std::size_t triangles = 0;
  Bounds bounds{};  // world space
  int lights = 0;
  int casting_lights = 0;  // that cast shadows and reach something
  int idle_lights = 0;     // that reach nothing
  bool environment = false;
  bool studio = false;              // the light is the studio's
  bool sized_lights = false;        // some light has a size
  bool glossy = false;              // some triangle's material is a rough mirror of Phong's
  bool microfacets = false;         // some triangle's material has glTF's model
  bool mirrors = false;             // some triangle's material reflects, transmits or blends
  double mirror_share = 0.0;        // share of the scene's surface that reflects or transmits
  double transmitting_share = 0.0;  // share that transmits
  bool glass = false;               // some triangle's material transmits, other than by alpha
  bool textures = false;            // some triangle's material has a texture
  bool vertex_colors = false;       // some triangle's material has vertex colours
  bool holes = false;               // some material has holes by its alpha
  bool blends = false;              // some material blends by its alpha
  // Bounces beyond which no ray brings its pixel kThroughputCutoff, or none meets another mirror.
  int useful_depth = kMostBounces;

  [[nodiscard]] bool transmits() const { return transmitting_share > 0.0; }
};

// One walk over lights and triangles.
[[nodiscard]] SceneStats analyze(const Scene& scene);

// The same for the poses of a scene, one after the other: areas of nodes that did not move are kept.
class PoseStats {
 public:
  [[nodiscard]] SceneStats of(const Scene& scene);

 private:
  enum class Kind : std::uint8_t { plain, mirror, see_through };
  struct Areas {
    double all = 0.0, mirroring = 0.0, transmitting = 0.0;
    void operator+=(const Areas& a) {
      all += a.all;
      mirroring += a.mirroring;
      transmitting += a.transmitting;
    }
  };
  void look_at_materials(const Mesh& mesh);
  [[nodiscard]] Areas areas_of(const Mesh& mesh, std::size_t first, std::size_t last) const;
  void add_areas(const Mesh& mesh, const MeshPose* before);

  std::shared_ptr<const MeshPose> pose_;  // the last one; null: of a mesh that was not posed
  SceneStats stats_;
  bool sampled_ = false, moves_ = false, sees_through_ = false;
  std::vector<Kind> kinds_;               // by material
  double most_ = 0.0;                     // that a mirror returns
  std::vector<std::uint32_t> mirroring_;  // the triangles that mirror or are seen through
  std::vector<Areas> nodes_;
  Areas others_;  // of the triangles of no node
};

// Updates the facts about lights; the triangles are not walked.
void recount_lights(const Scene& scene, SceneStats& stats);

}  // namespace pinocchio
