#pragma once

#include "gl/candidate.h"

namespace pinocchio::gl {

// Mesa's off-screen library, loaded at run time: the last resort, gone from Mesa 25.1 on.
[[nodiscard]] Candidate osmesa_candidate();

}  // namespace pinocchio::gl
