#pragma once

#include <string_view>

#include "core/files/file_bytes.h"

namespace pinocchio {

// Decodes RFC 4648. Other characters than its letters, such as padding and line ends, are skipped.
[[nodiscard]] FileBytes decode_base64(std::string_view text);

}  // namespace pinocchio
