#pragma once

namespace pinocchio::gl {

// OpenGL keeps the first error until somebody asks: what an older call left would hide a new one, or pass for
// one.
void forget_errors();
// Whether a call since then failed for want of memory.
[[nodiscard]] bool ran_out_of_memory();

}  // namespace pinocchio::gl
