#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pinocchio/progress.h"

namespace pinocchio {

// A file's bytes; nothing where it cannot be read. Phase "read".
[[nodiscard]] std::optional<std::string> read_bytes(const std::filesystem::path& file, Progress* progress);

}  // namespace pinocchio
