#pragma once

#include "gl/context/context.h"

namespace pinocchio::gl {

// Draws a few pixels in the current context and reads them back. It tests what all our pictures rely on and
// some drivers claim without doing it. Throws Error with the driver's name and what failed. Takes a few
// milliseconds.
void probe(const ContextInfo& info);

}  // namespace pinocchio::gl
