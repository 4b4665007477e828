// Closed meshes and rays from inside them: a ray without a hit has leaked.
#pragma once

#include <vector>

#include "pinocchio/mesh.h"
#include "pinocchio/ray.h"
#include "scenes/generator/random.h"

namespace pinocchio::stability {

// Appends a flat triangle of the mesh's last material, degenerate or not; a mesh without material gets one.
void add(MeshData& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

// A ball with vertices moved in and out by up to `rough` of the radius, and smooth normals.
[[nodiscard]] MeshData ball(const glm::vec3& center, float radius, int around, float rough = 0.0f);

// A box with sides of cells x cells squares. If corners and cells are powers of two, every coordinate is
// exact at any place.
[[nodiscard]] MeshData box(const glm::vec3& lo, const glm::vec3& hi, int cells);

// An octahedron of this `radius` with sides of cells x cells triangles that lie exactly in one plane.
[[nodiscard]] MeshData octahedron(const glm::vec3& center, float radius, int cells);

// A cube around the origin whose side towards +z is mostly strips a millionth as wide as they are long.
[[nodiscard]] MeshData room_of_strips(int strips);

// Two cones base to base: `around` triangles meet at either tip.
[[nodiscard]] MeshData double_cone(int around);

// A rough ball with some edges that are halved on one side only: rounding moves the middle off the edge,
// which may leave a gap.
[[nodiscard]] MeshData ball_with_t_junctions(int around);

// Square leaves of half side `size` across z, one behind the other, with an alpha mask in a material of their
// own. Three in ten texels are solid.
void add_leaves(MeshData& mesh, const glm::vec3& center, float size, int layers);

[[nodiscard]] glm::vec3 random_point(Random& random, float reach);
[[nodiscard]] glm::vec3 corner(const MeshData& mesh, std::uint32_t triangle, int i);

// Rays from points within `reach` of `center` towards vertices (one in four) and points on edges.
[[nodiscard]] std::vector<Ray> rays_at_edges(const MeshData& mesh, const glm::vec3& center, float reach,
                                             int rays);

}  // namespace pinocchio::stability
