#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "core/bsp/tree.h"
#include "core/trace/shared.h"

namespace pinocchio {

// A flat piece of a triangle, and the side of it that is looked at.
struct Piece {
  std::uint32_t triangle;
  std::array<glm::dvec3, 3> corners;  // of the piece, p_world
  glm::dvec3 n;                       // the triangle's unit normal on that side
  double lift_least, lift_most;       // how high above the triangle's plane shadow rays start
};

// The space between a piece and a light: every shadow ray of the piece runs in it. What it says is on the
// safe side by more than rounding: it may miss that nothing is in the way, never claim it wrongly.
class Shaft {
 public:
  // Nothing where the light is (nearly) in the piece's plane or behind it.
  static std::optional<Shaft> of(const Piece& piece, const shared::LightParams& light);

  // No triangle of the tree blocks any shadow ray of the piece.
  [[nodiscard]] bool clear(const BspTree& tree) const;

 private:
  // n . p + c >= 0 inside.
  struct Plane {
    glm::dvec3 n;
    double c;
    [[nodiscard]] double height(const glm::dvec3& p) const { return glm::dot(n, p) + c; }
  };

  explicit Shaft(const Piece& piece) : piece_(piece) {}
  [[nodiscard]] glm::dvec3 towards_light(const glm::dvec3& from) const;
  [[nodiscard]] bool meets(const Bounds& box) const;
  [[nodiscard]] bool beside(const std::array<glm::dvec3, 3>& triangle) const;
  [[nodiscard]] bool may_block(const BspTree& tree, std::uint32_t triangle) const;

  Piece piece_;
  bool parallel_ = false;            // directional light
  glm::dvec3 light_;                 // its place, or the way to it
  double end_margin_ = 0.0;          // how far a ray may miss the light
  double aside_ = 0.0;               // how far beside the piece it may start
  std::array<glm::dvec3, 3> grown_;  // the piece's corners, outwards by the rounding of the points in it
  std::array<Plane, 4> planes_;      // three sides and, lifted to where rays start, the bottom
};

}  // namespace pinocchio
