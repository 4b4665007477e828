#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "core/bsp/build/subtree.h"

namespace pinocchio {

// Parts of the tree that wait for a thread, and the subtrees built from them.
class PartQueue {
 public:
  // Returns the part's number.
  std::size_t push(TreePart part);

  // Removes the largest waiting part: the longest work starts first. Waits while other threads may still push
  // parts; returns nothing once all are built. The subtree of every popped part must be delivered.
  struct Waiting {
    std::size_t number;
    TreePart part;
  };
  [[nodiscard]] std::optional<Waiting> pop();
  void deliver(std::size_t number, Subtree built);
  // Ends all waiting, after an exception.
  void abandon();

  // Once all are built.
  [[nodiscard]] const Subtree& built(std::size_t number) const { return built_[number]; }
  [[nodiscard]] std::size_t size() const { return built_.size(); }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Waiting> waiting_;
  std::deque<Subtree> built_;
  int under_way_ = 0;
  bool abandoned_ = false;
};

}  // namespace pinocchio
