#pragma once

#include "pinocchio/open_gl_error.h"

namespace pinocchio::gl {

// The public exceptions, by the names used in gl.
using Error = OpenGlError;
using NoContextError = NoOpenGlError;
using ContextLostError = OpenGlLostError;

}  // namespace pinocchio::gl
