#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pinocchio {

// Describes what a file holds: how many bytes, and their CRC-32 (that of zlib and PNG). Returns nothing where
// the file is not a regular one or cannot be read to its end.
[[nodiscard]] std::optional<std::string> fingerprint(const std::filesystem::path& file);

}  // namespace pinocchio
