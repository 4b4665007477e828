#include "core/bsp/part_queue.h"

#include <algorithm>
#include <utility>

namespace pinocchio {

std::size_t PartQueue::put(TreePart part) {
  const std::lock_guard lock(mutex_);
  const std::size_t number = made_.size();
  made_.emplace_back();
  waiting_.push_back({number, std::move(part)});
  changed_.notify_one();
  return number;
}

std::optional<PartQueue::Taken> PartQueue::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return abandoned_ || !waiting_.empty() || under_way_ == 0; });
  if (abandoned_ || waiting_.empty()) return std::nullopt;
  const auto largest = std::max_element(waiting_.begin(), waiting_.end(), [](const Taken& a, const Taken& b) {
    return a.part.references.size() < b.part.references.size();
  });
  Taken taken = std::move(*largest);
  if (largest != waiting_.end() - 1) *largest = std::move(waiting_.back());
  waiting_.pop_back();
  ++under_way_;
  return taken;
}

void PartQueue::give(std::size_t number, Subtree made) {
  const std::lock_guard lock(mutex_);
  made_[number] = std::move(made);
  if (--under_way_ == 0 && waiting_.empty()) changed_.notify_all();
}

void PartQueue::abandon() {
  const std::lock_guard lock(mutex_);
  abandoned_ = true;
  changed_.notify_all();
}

}  // namespace pinocchio
