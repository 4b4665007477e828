#pragma once

#include <filesystem>
#include <string>

#include "pinocchio/error.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// Reads an OBJ's lines for what would mislead the parser behind it: coordinates that are not finite
// numbers, faces of vertices that there are not. Errors carry the line. Slashes that end a face's corner
// (1/2/) become spaces: the parser would read the next corner's number into them.
[[nodiscard]] Expected<void> check_obj_text(std::string& text, const std::filesystem::path& file,
                                            const Progress* progress = nullptr);

}  // namespace pinocchio
