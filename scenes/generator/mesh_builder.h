#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "pinocchio/mesh.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// `count` cells of a surface at `scale`: 2 or more.
[[nodiscard]] int cells(float count, float scale);

// Appends shapes to a mesh. Corners run counter-clockwise seen from outside; what is placed goes through
// the current transform (which must not mirror).
class MeshBuilder {
 public:
  // `progress` advances by a step a triangle.
  explicit MeshBuilder(MeshData& mesh, Progress* progress = nullptr) : mesh_(mesh), progress_(progress) {}

  // Shapes from here on are of this material.
  void use(const Material& material);
  // ... and go through this transform.
  void place(const glm::mat4& world_from_shape) { place_ = world_from_shape; }

  // Flat shapes.
  void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  void quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d);
  void box(const glm::vec3& lo, const glm::vec3& hi);

  // Smooth shapes.
  using Surface = std::function<glm::vec3(float u, float v)>;  // u, v in [0, 1]
  // nu x nv cells; its outside is where the surface's du x dv points. With `closed_u`, u = 1 is u = 0.
  // Cells that shrink to nothing (a pole, a bow) give no triangles.
  void surface(int nu, int nv, bool closed_u, const Surface& point);
  // 2 * around * (around / 2 - 1) triangles; closed.
  void sphere(const glm::vec3& center, float radius, int around);
  // A profile (radius, height), from the bottom up, turned around the y axis.
  void lathe(const std::vector<glm::vec2>& profile, int around);
  // A pipe along a path, without ends.
  void tube(const std::vector<glm::vec3>& path, float radius, int around);
  void torus(const glm::vec3& center, float radius, float pipe_radius, int around, int pipe_around);

 private:
  std::uint32_t vertex(const glm::vec3& p, const glm::vec3& n);
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  MeshData& mesh_;
  Progress* progress_;
  glm::mat4 place_{1.0f};
};

// A profile's corners rounded: Chaikin's subdivision, `rounds` times; the ends stay.
[[nodiscard]] std::vector<glm::vec2> rounded(std::vector<glm::vec2> profile, int rounds);

}  // namespace pinocchio
