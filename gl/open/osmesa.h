#pragma once

#include "gl/open/candidate.h"

namespace pinocchio::gl {

// Mesa's off-screen library, loaded at run time. The last resort: Mesa 25.1 and later do not have it.
[[nodiscard]] Candidate osmesa_candidate();

}  // namespace pinocchio::gl
