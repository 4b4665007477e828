#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

#include "core/bsp/scene_trees.h"
#include "core/bsp/wide/wide_tree.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// The wide tree over what stands still, which is built when incoherent rays have been so many that it pays.
// Until then it takes neither time nor memory. It serves all poses that share the still tree. May be called
// from many threads.
class WideOnDemand {
 public:
  // True if all or more than half of the scene's triangles are in the still tree, stored for the filtered
  // test. Isa::scalar is never served: tests compare all other ways with it.
  [[nodiscard]] static bool serves(const SceneTrees& trees, Isa isa);

  // isa: of the packets. threads: for the build; 0: one for each core.
  WideOnDemand(std::shared_ptr<const BspTree> still, Isa isa, int threads);

  // Counts that many incoherent rays. Null: trace them in packets. The call that reaches the limit builds the
  // tree; other threads use packets meanwhile. `scene`: in any pose that has the still tree.
  [[nodiscard]] const WideTree* tree_after(std::size_t rays, const SceneTrees& scene);

  // The distance between neighbouring rays at the scene's centre from which on they are incoherent, scene
  // units.
  [[nodiscard]] float apart() const { return apart_; }
  [[nodiscard]] const glm::vec3& center() const { return center_; }

 private:
  void build(const SceneTrees& scene) noexcept;

  int threads_;
  glm::vec3 center_;
  float apart_;
  std::size_t enough_;  // rays
  std::atomic<std::size_t> rays_ = 0;
  std::atomic<bool> begun_ = false;
  std::unique_ptr<const WideTree> tree_;
  std::atomic<const WideTree*> built_ = nullptr;  // tree_, once it may be used
};

}  // namespace pinocchio
