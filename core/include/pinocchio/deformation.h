// Parts of a mesh that change their shape: morph targets, and skins that follow joints.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// The offsets that a weight of one adds to a node's vertices.
struct MorphTarget {
  std::vector<std::uint32_t> vertices;  // the moved ones, counted from the node's first
  // One for each of these vertices; empty: the target does not change them.
  std::vector<glm::vec3> positions, normals, tangents;
};

struct Skin {
  std::vector<int> joints;                 // nodes
  std::vector<glm::mat4> joint_from_mesh;  // one for each joint: the inverse bind matrices
};

// How much a vertex follows a joint of its node's skin.
struct Influence {
  std::uint32_t joint = 0;
  float weight = 0.0f;
};

// The deformation of one node. Targets are added first, then the skin places the result. A node with a skin
// follows its joints, not its own transform.
struct Deformation {
  int node = -1;
  std::vector<MorphTarget> targets;
  int skin = -1;                      // index in RestPose::skins; -1: none
  std::vector<Influence> influences;  // `influences_per_vertex` for each vertex; weights add up to 1
  std::size_t influences_per_vertex = 0;
};

}  // namespace pinocchio
