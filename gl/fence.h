#pragma once

#include "gl/handle.h"

namespace pinocchio::gl {

struct DeleteSync {
  void operator()(GLsync name) const { glDeleteSync(name); }
};

// A point in the GPU's work that the CPU can ask about; move-only.
class Fence {
 public:
  // Marks the work given to the GPU so far, and sends it off. Throws Error.
  static Fence insert();

  // Returns when the GPU has come this far; an empty fence does at once. Throws ContextLostError when the
  // context is lost.
  void wait() const;

 private:
  Handle<DeleteSync, GLsync> sync_;
};

}  // namespace pinocchio::gl
