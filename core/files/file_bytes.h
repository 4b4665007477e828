#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "core/base/large_memory.h"

namespace pinocchio {

// The bytes of a file, or bytes unpacked from one. Unlike a vector's, they are not set to zero before they
// are written.
class FileBytes {
 public:
  FileBytes() = default;
  explicit FileBytes(std::size_t size)
      : memory_(std::make_unique_for_overwrite<char[]>(size)), first_(memory_.get()), size_(size) {
    prefer_large_pages(first_, size);
  }

  [[nodiscard]] char* data() { return first_; }
  [[nodiscard]] const char* data() const { return first_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] char* begin() { return first_; }
  [[nodiscard]] char* end() { return first_ + size_; }
  [[nodiscard]] std::string_view text() const { return {first_, size_}; }
  [[nodiscard]] std::span<const unsigned char> unsigned_bytes() const {
    return {reinterpret_cast<const unsigned char*>(first_), size_};
  }

  void drop_front(std::size_t count) { first_ += count, size_ -= count; }
  void drop_back(std::size_t count) { size_ -= count; }

 private:
  std::unique_ptr<char[]> memory_;
  char* first_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace pinocchio
