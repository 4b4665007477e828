// How a scene moves by itself: what its file says of nodes and weights over time.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "pinocchio/camera.h"
#include "pinocchio/error.h"
#include "pinocchio/glm_layout.h"

namespace pinocchio {

struct Scene;

// Keys of one value, and what lies between them.
struct Track {
  enum class Path { translation, rotation, scale, weights };
  enum class Interpolation { step, linear, cubic_spline };

  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;  // of rotations: spherical
  std::vector<float> times_s;                           // not falling, at least one
  // For each key `width` numbers (a rotation's are x, y, z, w); of cubic splines three times as many: tangent
  // in, value, tangent out.
  std::vector<float> values;
  std::size_t width = 3;
  std::size_t clip = 0;  // of the animation's: the one that it came with

  // Before the first key its value, behind the last one that key's. to.size() == width
  void sample(double seconds, std::vector<float>& to) const;
};

// A node's transform in its parts: scaled, then turned, then moved.
struct NodeMotion {
  glm::vec3 translation{0.0f};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::vec3 scale{1.0f};

  [[nodiscard]] glm::mat4 matrix() const;
};

struct AnimatedNode {
  int node = -1;
  NodeMotion at_rest;  // what no track moves
  std::vector<Track> tracks;
};

// Animations of a file play together, each from 0 s on. Of two that move the same only the first is kept.
struct Animation {
  struct Clip {
    std::string name;
    double duration_s = 0.0;
  };
  std::vector<Clip> clips;
  std::vector<AnimatedNode> nodes;  // indices rise
  double duration_s = 0.0;          // of the longest
};

// Of its animation; 0 where it has none.
[[nodiscard]] double duration_s(const Scene& scene);

// Its cameras at that time; at_time()'s, without the rest.
[[nodiscard]] std::vector<Camera> cameras_at(const Scene& scene, double seconds);

// The scene as it is that long after its animation began, made of the rest pose alone: the same bits,
// whichever pose `scene` is in. What nothing moves stays as it is. A new mesh of the same triangles and
// materials, as posed() makes it; of a scene without animation, the scene itself. Errors: no finite time, or
// a pose that leaves the mesh no finite numbers.
[[nodiscard]] Expected<Scene> at_time(const Scene& scene, double seconds);

}  // namespace pinocchio
