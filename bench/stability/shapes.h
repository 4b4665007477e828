// Closed meshes and rays from inside them: whatever leaves without a hit has leaked.
#pragma once

#include <vector>

#include "pinocchio/mesh.h"
#include "pinocchio/ray.h"
#include "scenes/generator/random.h"

namespace pinocchio::stability {

// Appends a flat triangle of the mesh's last material, degenerate or not; a mesh without material gets one.
void add(MeshData& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

// A ball whose vertices are moved in and out by up to `rough` of the radius; smooth normals.
[[nodiscard]] MeshData ball(const glm::vec3& center, float radius, int around, float rough = 0.0f);

// A box, each side cells x cells squares. With corners and cells that are powers of two every coordinate is
// exact, wherever it stands.
[[nodiscard]] MeshData box(const glm::vec3& lo, const glm::vec3& hi, int cells);

// An octahedron of this `radius`, each side cells x cells triangles that lie exactly in one plane.
[[nodiscard]] MeshData octahedron(const glm::vec3& center, float radius, int cells);

// A cube around the origin whose side towards +z is mostly strips a millionth as wide as they are long.
[[nodiscard]] MeshData room_of_strips(int strips);

// Two cones base to base: `around` triangles meet at either tip.
[[nodiscard]] MeshData double_cone(int around);

// A rough ball, of whose edges some are halved on one side only: the middle lies beside the edge by its
// rounding, and leaves a gap or not.
[[nodiscard]] MeshData ball_with_t_junctions(int around);

// Square leaves of half side `size` across z, one behind the other, of whose texels three in ten are solid:
// an alpha mask of a material of their own.
void add_leaves(MeshData& mesh, const glm::vec3& center, float size, int layers);

[[nodiscard]] glm::vec3 random_point(Random& random, float reach);
[[nodiscard]] glm::vec3 corner(const MeshData& mesh, std::uint32_t triangle, int i);

// From around `center`, by up to `reach`, towards vertices (one in four) and points on edges.
[[nodiscard]] std::vector<Ray> rays_at_edges(const MeshData& mesh, const glm::vec3& center, float reach,
                                             int rays);

}  // namespace pinocchio::stability
