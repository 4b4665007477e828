#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pinocchio {

// A file's contents in short: the number of bytes, and their CRC-32 (as in zlib and PNG). None if the file is
// not a regular one or cannot be read to its end.
[[nodiscard]] std::optional<std::string> fingerprint(const std::filesystem::path& file);

}  // namespace pinocchio
