#pragma once

#include "gl/context.h"

namespace pinocchio::gl {

// Draws a few pixels into the current context and reads them back: what all our pictures rely on, and what
// some drivers claim and do not do. Throws Error that names the driver and what failed. A few milliseconds.
void probe(const ContextInfo& info);

}  // namespace pinocchio::gl
