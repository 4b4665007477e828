// A scene's own motion: nodes and weights over time, as its file gives them.
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

// The keys of one value, and how it is interpolated between them.
struct Track {
  enum class Path { translation, rotation, scale, weights };
  enum class Interpolation { step, linear, cubic_spline };

  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;  // rotations: spherically
  std::vector<float> times_s;                           // never falling, at least one
  // `width` numbers for each key (a rotation's are x, y, z, w). A cubic spline has three times as many:
  // tangent in, value, tangent out.
  std::vector<float> values;
  std::size_t width = 3;
  std::size_t clip = 0;  // index of the file's animation that has the track

  // Before the first key: its value. After the last key: its value. to.size() == width
  void sample(double seconds, std::vector<float>& to) const;
};

// A node's transform in parts: it is scaled, then rotated, then moved.
struct NodeMotion {
  glm::vec3 translation{0.0f};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::vec3 scale{1.0f};

  [[nodiscard]] glm::mat4 matrix() const;
};

struct AnimatedNode {
  int node = -1;
  NodeMotion at_rest;  // for the parts without a track
  std::vector<Track> tracks;
};

// The animations of a file play together, each from 0 s. If two move the same part, the first counts.
struct Animation {
  struct Clip {
    std::string name;
    double duration_s = 0.0;
  };
  std::vector<Clip> clips;
  std::vector<AnimatedNode> nodes;  // indices rise
  double duration_s = 0.0;          // the longest animation's
};

// The animation's duration; 0 without animation.
[[nodiscard]] double duration_s(const Scene& scene);

// The cameras that at_time() gives, without the rest of the scene.
[[nodiscard]] std::vector<Camera> cameras_at(const Scene& scene, double seconds);

// The scene `seconds` into its animation. It is computed from the rest pose, so that the result has the same
// bits whatever pose `scene` is in. The mesh is new, with the same triangles and materials, as posed() makes
// it. A scene without animation is returned as it is. Errors: the time is not finite, or the pose gives the
// mesh numbers that are not.
[[nodiscard]] Expected<Scene> at_time(const Scene& scene, double seconds);

}  // namespace pinocchio
