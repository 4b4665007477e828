// Settings as Python says them: keyword arguments by the names of the one table.
#pragma once

#include <pinocchio/settings.h>

#include "python/src/convert.h"

namespace pinocchio::python {

// Presets first, so that a field goes before them. Throws Error.
[[nodiscard]] Settings settings_of(const nb::kwargs& arguments, int threads);
// A line a field: its name, domain, default and meaning.
[[nodiscard]] std::string settings_help();

}  // namespace pinocchio::python
