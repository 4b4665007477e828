#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "core/bsp/moving/kept_tree.h"
#include "core/bsp/scene_trees.h"
#include "pinocchio/build_options.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// The copies of meshes (RestPose::copies) that share a mesh's tree, which is built in the space of its rest
// pose. They need no triangles of their own.
class SharedCopies {
 public:
  struct Copy {
    std::uint32_t index;  // in RestPose::copies
    MovingTree placed{};  // without a tree: not placed yet
    Bounds bounds{};      // of its triangles that have an area
  };

  SharedCopies() = default;
  // Chooses them: all copies of a node, or none.
  SharedCopies(const Scene& scene, const BuildOptions& options);

  // Takes over what another pose of the scene has of the same copies. `differs`: the nodes that have moved.
  void keep(const SharedCopies& before, const std::vector<bool>& differs);
  // Places the copies that have no tree yet. `for_each(n, body)` calls body(i) for all of [0, n).
  using ForEach = std::function<void(std::size_t n, const std::function<void(std::size_t)>& body)>;
  void place(const Scene& scene, const BuildOptions& options, const ForEach& for_each);

  [[nodiscard]] bool empty() const { return copies_.empty(); }
  [[nodiscard]] bool has_node(std::size_t node) const { return node < has_node_.size() && has_node_[node]; }
  [[nodiscard]] const std::vector<Copy>& copies() const { return copies_; }

 private:
  struct SharedTree {
    KeptTree kept;
    std::size_t of;  // the copy that it was built from, in RestPose::copies
  };

  std::vector<Copy> copies_;
  std::vector<int> nodes_;                                  // of each
  std::vector<bool> has_node_;                              // by node
  std::map<int, std::shared_ptr<const SharedTree>> trees_;  // by mesh
};

}  // namespace pinocchio
