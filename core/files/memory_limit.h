#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "pinocchio/error.h"

namespace pinocchio {

// The memory that a scene's files may claim beyond their own size: for unpacked pictures, compressed meshes
// and copies of a mesh. Readers call take() before they allocate. Any thread.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t bytes) : bytes_(bytes) {}

  // Takes `count` times `each` bytes for `what` in `file`. False: they do not fit, and error() says so. The
  // first error stays.
  [[nodiscard]] bool take(const std::string& file, const std::string& what, std::uint64_t count,
                          std::uint64_t each) {
    const std::uint64_t most = ~std::uint64_t{0} / 2, wanted = count > most / each ? most : count * each;
    const std::lock_guard lock(mutex_);
    if (!error_ && wanted <= bytes_ - taken_) {
      taken_ += wanted;
      return true;
    }
    if (!error_)
      error_ = InputError{file, 0,
                          what + " needs " + mib(wanted) + " MiB of memory, " + mib(bytes_ - taken_) +
                              " of " + mib(bytes_) + " are left",
                          "raise it with --load-limit MIB (Python: load_limit) if the file is to be trusted"};
    return false;
  }

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }  // in all
  [[nodiscard]] const std::optional<InputError>& error() const { return error_; }

 private:
  static std::string mib(std::uint64_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20); }

  std::uint64_t bytes_, taken_ = 0;
  std::mutex mutex_;
  std::optional<InputError> error_;
};

}  // namespace pinocchio
