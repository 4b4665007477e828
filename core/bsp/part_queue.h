#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "core/bsp/subtree.h"

namespace pinocchio {

// Parts of the tree that wait for a thread, and what was made of them.
class PartQueue {
 public:
  // Returns the part's number.
  std::size_t put(TreePart part);

  // The largest part that waits: the longest work is begun first. Waits while others may still put some;
  // nothing once all are made. Who takes a part must give what it makes.
  struct Taken {
    std::size_t number;
    TreePart part;
  };
  [[nodiscard]] std::optional<Taken> take();
  void give(std::size_t number, Subtree made);
  // After an exception: nobody waits any longer.
  void abandon();

  // Once all are made.
  [[nodiscard]] const Subtree& made(std::size_t number) const { return made_[number]; }
  [[nodiscard]] std::size_t size() const { return made_.size(); }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Taken> waiting_;
  std::deque<Subtree> made_;
  int under_way_ = 0;
  bool abandoned_ = false;
};

}  // namespace pinocchio
