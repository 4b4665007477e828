// Parts of a mesh whose shape changes: morph targets, and skins that follow joints.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// What a weight of one adds to a node's vertices.
struct MorphTarget {
  std::vector<std::uint32_t> vertices;  // that it moves, counted from the node's first
  // One each of them; empty where the target leaves them as they are.
  std::vector<glm::vec3> positions, normals, tangents;
};

struct Skin {
  std::vector<int> joints;                 // nodes
  std::vector<glm::mat4> joint_from_mesh;  // one a joint: the inverse bind matrices
};

// How much of a vertex follows a joint of its node's skin.
struct Influence {
  std::uint32_t joint = 0;
  float weight = 0.0f;
};

// Of one node. Targets are added first, then the skin places what they made; a node with a skin follows its
// joints, not its own transform.
struct Deformation {
  int node = -1;
  std::vector<MorphTarget> targets;
  int skin = -1;                      // in RestPose::skins; -1: none
  std::vector<Influence> influences;  // `influences_per_vertex` for each vertex, weights' sum 1
  std::size_t influences_per_vertex = 0;
};

}  // namespace pinocchio
