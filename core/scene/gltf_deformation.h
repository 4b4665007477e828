// Morph targets and skins, read with suspicion.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/gltf_file.h"
#include "pinocchio/animation.h"

namespace pinocchio {

// Gathers what deforms one node's vertices, primitive by primitive.
class DeformationReader {
 public:
  // `first_vertex`: of the node, in the scene.
  DeformationReader(const GltfFile& file, const tinygltf::Node& node, std::uint32_t first_vertex,
                    Warnings& warnings);

  [[nodiscard]] bool needed() const { return targets_ > 0 || skinned(); }
  [[nodiscard]] bool skinned() const { return joints_ > 0; }
  // Of `count` vertices that begin at the scene's vertex `first`; none of the node's is left out between
  // calls.
  [[nodiscard]] Expected<void> add(const tinygltf::Primitive& primitive, std::uint32_t first,
                                   std::size_t count);
  // An instance moves what its vertices, from the scene's `first` on, are moved by. normals: the mesh's,
  // before that.
  void place(const glm::mat4& instance, std::uint32_t first, std::span<const glm::vec3> normals);
  // The weights of the targets as the file has them, one each.
  [[nodiscard]] std::vector<float> weights() const;

  [[nodiscard]] Deformation take() { return std::move(deformation_); }

 private:
  Expected<void> add_target(const std::map<std::string, int>& accessors, std::uint32_t first,
                            std::size_t count, MorphTarget& to);
  Expected<void> add_influences(const tinygltf::Primitive& primitive, std::size_t count);
  void settle_weights(std::span<Influence> of_vertex);
  void warn(const std::string& what, const std::string& lost);

  const GltfFile& file_;
  const tinygltf::Node& node_;
  std::uint32_t first_vertex_;
  Warnings& warnings_;
  std::size_t targets_ = 0, joints_ = 0;
  Deformation deformation_;
};

// Accessors of morph targets, skin and weights: primitives that differ in them have vertices of their own.
[[nodiscard]] std::vector<int> deforming_accessors(const tinygltf::Primitive& primitive);

// The skin with its joints' places in the scene, which `place_of_node` gives by the file's node; nothing
// where one of them is not in the scene.
[[nodiscard]] Expected<std::optional<Skin>> gltf_skin(const GltfFile& file, int skin,
                                                      const std::vector<int>& place_of_node);

// A node's transform in its parts, without its matrix.
[[nodiscard]] NodeMotion gltf_motion(const tinygltf::Node& node);

// The file's animations of nodes that are in the scene; null where there are none.
[[nodiscard]] Expected<std::shared_ptr<const Animation>> gltf_animation(const GltfFile& file,
                                                                        const NodeTree& tree,
                                                                        const std::vector<int>& place_of_node,
                                                                        Warnings& warnings);

}  // namespace pinocchio
