#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/error.h"

namespace pinocchio {

// Reads an OBJ's lines for what would mislead the parser behind it: coordinates that are not finite
// numbers, faces of vertices that there are not. Errors carry the line.
[[nodiscard]] Expected<void> check_obj_text(std::string_view text, const std::filesystem::path& file);

}  // namespace pinocchio
