#pragma once

#include <vector>

#include "gl/candidate.h"

namespace pinocchio::gl {

// EGL's ways to a context without a display, best first: hardware devices, software devices, Mesa's
// surfaceless platform, the default display. Where the library is missing, one candidate that says so.
[[nodiscard]] std::vector<Candidate> egl_candidates();

}  // namespace pinocchio::gl
