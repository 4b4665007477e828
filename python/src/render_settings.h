// Settings as Python's keyword arguments, with the names of settings_table().
#pragma once

#include <pinocchio/settings.h>

#include "python/src/support/convert.h"

namespace pinocchio::python {

// Presets are applied first, so that single fields override them. Throws Error.
[[nodiscard]] Settings settings_of(const nb::kwargs& arguments, int threads);
// One line for each field: its name, domain, default and meaning.
[[nodiscard]] std::string settings_help();

}  // namespace pinocchio::python
