#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "pinocchio/error.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// Settings as people read, edit and give them back: every field by its name; without those of the machine,
// what a picture depends on alone.
[[nodiscard]] nlohmann::json to_json(const Settings& settings, bool with_machine = true);

// The settings of a file: their JSON, or an object that holds it under "plan" (as 'info --plan --json' and
// --stats-json write). What is left out is not given. Files of the first version (mode, design, primary)
// still read. An error, with the line where it is known: the file cannot be read, is no JSON, has a field or
// a value that is none.
[[nodiscard]] Expected<Settings> load_settings(const std::filesystem::path& file);

}  // namespace pinocchio
