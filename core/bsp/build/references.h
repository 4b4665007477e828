#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>

#include "core/bsp/build/build_reference.h"

namespace pinocchio {

// A known number of references, without initial values.
class References {
 public:
  References() = default;
  explicit References(std::size_t n)
      : first_(std::make_unique_for_overwrite<BuildReference[]>(n)), size_(n) {}
  void shrink(std::size_t n) { size_ = n; }
  void put(std::span<const BuildReference> from, std::size_t at) {
    std::copy(from.begin(), from.end(), first_.get() + at);
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] BuildReference& operator[](std::size_t i) { return first_[i]; }
  [[nodiscard]] std::span<const BuildReference> span() const { return {first_.get(), size_}; }

 private:
  std::unique_ptr<BuildReference[]> first_;
  std::size_t size_ = 0;
};

}  // namespace pinocchio
