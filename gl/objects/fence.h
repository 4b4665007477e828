#pragma once

#include "gl/context/handle.h"

namespace pinocchio::gl {

struct DeleteSync {
  void operator()(GLsync name) const { glDeleteSync(name); }
};

// A point in the GPU's work that the CPU can wait for. Move-only.
class Fence {
 public:
  // Marks the end of the work given to the GPU so far, and flushes it. Throws Error.
  static Fence insert();

  // Returns when the GPU has reached this point, at once if the fence is empty. Throws ContextLostError when
  // the context is lost.
  void wait() const;

 private:
  Handle<DeleteSync, GLsync> sync_;
};

}  // namespace pinocchio::gl
