#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pinocchio {

// What a file holds, as text: the CRC-32 of its bytes (that of zlib and PNG) and how many there are. Nothing
// where it is no regular file that can be read to its end.
[[nodiscard]] std::optional<std::string> fingerprint(const std::filesystem::path& file);

}  // namespace pinocchio
