#pragma once

#include "pinocchio/open_gl_error.h"

namespace pinocchio::gl {

// The public family, by the names that are used here.
using Error = OpenGlError;
using NoContextError = NoOpenGlError;
using ContextLostError = OpenGlLostError;

}  // namespace pinocchio::gl
