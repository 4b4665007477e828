#include "core/bsp/build/part_queue.h"

#include <algorithm>
#include <utility>

namespace pinocchio {

std::size_t PartQueue::push(TreePart part) {
  const std::lock_guard lock(mutex_);
  const std::size_t number = built_.size();
  built_.emplace_back();
  waiting_.push_back({number, std::move(part)});
  changed_.notify_one();
  return number;
}

std::optional<PartQueue::Waiting> PartQueue::pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return abandoned_ || !waiting_.empty() || under_way_ == 0; });
  if (abandoned_ || waiting_.empty()) return std::nullopt;
  const auto largest = std::max_element(
      waiting_.begin(), waiting_.end(),
      [](const Waiting& a, const Waiting& b) { return a.part.references.size() < b.part.references.size(); });
  Waiting next = std::move(*largest);
  if (largest != waiting_.end() - 1) *largest = std::move(waiting_.back());
  waiting_.pop_back();
  ++under_way_;
  return next;
}

void PartQueue::deliver(std::size_t number, Subtree built) {
  const std::lock_guard lock(mutex_);
  built_[number] = std::move(built);
  if (--under_way_ == 0 && waiting_.empty()) changed_.notify_all();
}

void PartQueue::abandon() {
  const std::lock_guard lock(mutex_);
  abandoned_ = true;
  changed_.notify_all();
}

}  // namespace pinocchio
