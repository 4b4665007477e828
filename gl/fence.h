#pragma once

#include <glad/gl.h>

#include <utility>

namespace pinocchio::gl {

// A point in the GPU's work that the CPU can ask about; move-only.
class Fence {
 public:
  Fence() = default;
  ~Fence() { reset(); }
  Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
  Fence& operator=(Fence&& other) noexcept {
    if (this != &other) {
      reset();
      sync_ = std::exchange(other.sync_, nullptr);
    }
    return *this;
  }

  // Marks the work given to the GPU so far, and sends it off.
  static Fence insert();

  // Returns when the GPU has come this far; an empty fence does at once. Throws
  // ContextLostError when the context is lost.
  void wait() const;

 private:
  void reset() {
    if (sync_) glDeleteSync(sync_);
    sync_ = nullptr;
  }

  GLsync sync_ = nullptr;
};

}  // namespace pinocchio::gl
