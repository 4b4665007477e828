// The parts of the module, one file each.
#pragma once

#include "python/src/support/convert.h"

namespace pinocchio::python {

void bind_camera(nb::module_& module);
void bind_material(nb::module_& module);
void bind_light(nb::module_& module);
void bind_scene(nb::module_& module);
void bind_result(nb::module_& module);
void bind_engine(nb::module_& module);
void bind_tracer(nb::module_& module);
void bind_compare(nb::module_& module);

}  // namespace pinocchio::python
