// Lights and cameras of a glTF file, placed by the node that they are attached to.
#pragma once

#include <string_view>

#include "core/scene/gltf/file.h"
#include "pinocchio/camera.h"
#include "pinocchio/light.h"

namespace pinocchio {

// Returns whether glTF defines this light `type`.
[[nodiscard]] bool is_light_type(std::string_view type);

// Placed by `world`, the node's transform, with what our extras tell. A type that glTF does not have shines
// as the first kind.
[[nodiscard]] Light light_of(const nlohmann::json& json, const GltfNode& node, const glm::mat4& world);
// Looks along -Z; only `target` of our extras tells how far the target is.
[[nodiscard]] Camera camera_of(const nlohmann::json& json, const GltfNode& node, const glm::mat4& world);

// In the space of the node whose transform is `world`. Its own place has no rounding.
[[nodiscard]] Light at_rest(const glm::mat4& world, const Light& light);
[[nodiscard]] Camera at_rest(const glm::mat4& world, const Camera& camera);

// False: some number of the light is NaN or infinite.
[[nodiscard]] bool can_shine(const Light& light);

}  // namespace pinocchio
