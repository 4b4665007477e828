#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "pinocchio/error.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// Settings as JSON that people can edit: every field by its name. with_machine: false leaves out the fields
// that change no pixel.
[[nodiscard]] nlohmann::json to_json(const Settings& settings, bool with_machine = true);

// Reads settings: their JSON, or an object with it under "plan" (as 'info --plan --json' and --stats-json
// write). Fields that are left out are not given. Files of the first version (mode, design, primary) are read
// too. An error, with the line where it is known, where the file cannot be read, is no JSON, or has an
// unknown field or value.
[[nodiscard]] Expected<Settings> load_settings(const std::filesystem::path& file);

}  // namespace pinocchio
