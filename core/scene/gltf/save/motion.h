// What save_gltf writes of a scene that moves: its nodes, each with its part of the mesh at rest, skins,
// morph targets and animations.
#pragma once

#include "core/scene/gltf/save/data.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// Whether its nodes and animation can be written: it moves, and each triangle is some node's.
[[nodiscard]] bool can_save_motion(const Scene& scene);

// The scene's nodes, in their order; returned is each one's index in the file. Lights and cameras are not
// written.
std::vector<int> add_moving_nodes(const Scene& scene, GltfData& data);

// World from each node where no track moves it yet.
[[nodiscard]] std::vector<glm::mat4> world_at_rest(const Scene& scene);

// Once all nodes are there.
void add_skins_and_animation(const Scene& scene, const std::vector<int>& place_of_node, GltfData& data);

}  // namespace pinocchio
