#include "pinocchio/mesh.h"

namespace pinocchio {

// A vertex that there is not is left to check_scene.
Mesh::Mesh(MeshData data) : MeshData(std::move(data)) {
  for (const glm::uvec3& t : triangles)
    for (int i = 0; i < 3; ++i)
      if (t[i] < positions.size()) bounds_.add(positions[t[i]]);
}

}  // namespace pinocchio
