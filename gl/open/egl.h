#pragma once

#include <vector>

#include "gl/open/candidate.h"

namespace pinocchio::gl {

// EGL's ways to a context without a display, best first: hardware devices, software devices, Mesa's
// surfaceless platform, the default display. If the library is missing: one candidate that fails with the
// reason.
[[nodiscard]] std::vector<Candidate> egl_candidates();

}  // namespace pinocchio::gl
