// Morph targets and skins.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/gltf/file.h"
#include "pinocchio/animation.h"

namespace pinocchio {

// Collects the deformation of one node's vertices, primitive by primitive.
class DeformationReader {
 public:
  // `first_vertex`: the index in the scene of the node's first vertex.
  DeformationReader(const GltfFile& file, const GltfNode& node, std::uint32_t first_vertex,
                    Warnings& warnings);

  [[nodiscard]] bool needed() const { return targets_ > 0 || skinned(); }
  [[nodiscard]] bool skinned() const { return joints_ > 0; }
  // Adds `count` vertices that begin at the scene's vertex `first`. Calls follow the order of the node's
  // vertices without gaps. `sources`: the primitive's vertex that each follows, of balls and tubes, whose
  // normals keep their directions; empty: its own.
  [[nodiscard]] Expected<void> add(const GltfPrimitive& primitive, std::uint32_t first, std::size_t count,
                                   std::span<const std::uint32_t> sources = {});
  // Transforms the offsets of an instance's vertices, from the scene's `first` on. normals: the mesh's,
  // untransformed.
  void place(const glm::mat4& instance, std::uint32_t first, std::span<const glm::vec3> normals);
  // The file's weights, one for each target.
  [[nodiscard]] std::vector<float> weights() const;

  [[nodiscard]] Deformation result() { return std::move(deformation_); }

 private:
  Expected<void> add_target(const GltfAttributes& accessors, std::uint32_t first, std::size_t count,
                            std::span<const std::uint32_t> sources, MorphTarget& to);
  Expected<void> add_influences(const GltfPrimitive& primitive, std::size_t count,
                                std::span<const std::uint32_t> sources);
  void settle_weights(std::span<Influence> of_vertex);
  void warn(const std::string& what, const std::string& lost);

  const GltfFile& file_;
  const GltfNode& node_;
  std::uint32_t first_vertex_;
  Warnings& warnings_;
  std::size_t targets_ = 0, joints_ = 0;
  Deformation deformation_;
};

// Accessors of morph targets, joints and weights: primitives share vertices only where these are the same.
[[nodiscard]] std::vector<int> deforming_accessors(const GltfPrimitive& primitive);

// The skin, its joints as indices of the scene's nodes, to which `place_of_node` maps the file's. None: a
// joint is not in the scene.
[[nodiscard]] Expected<std::optional<Skin>> gltf_skin(const GltfFile& file, int skin,
                                                      const std::vector<int>& place_of_node);

// The file's animations of nodes that are in the scene; null where there are none. `chosen`: the name or the
// number of the only one that is read; empty: all.
[[nodiscard]] Expected<std::shared_ptr<const Animation>> gltf_animation(const GltfFile& file,
                                                                        const NodeTree& tree,
                                                                        const std::vector<int>& place_of_node,
                                                                        Warnings& warnings,
                                                                        const std::string& chosen);

}  // namespace pinocchio
