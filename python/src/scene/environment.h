// The light around a scene.
#pragma once

#include <pinocchio/load.h>

#include "python/src/scene/scene.h"

namespace pinocchio::python {

// Raises each as a Python warning.
void warn_of(const Warnings& warnings);

// `value`: None, the path of a file, or an array of light. Throws Error.
void set_environment(PyScene& self, nb::handle value);
// None, or the light as an array that keeps it alive.
[[nodiscard]] nb::object environment_of(const PyScene& self);

}  // namespace pinocchio::python
