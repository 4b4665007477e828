#pragma once

#include <string_view>

#include "core/scene/file_bytes.h"

namespace pinocchio {

// RFC 4648. What is none of its letters is skipped: padding, line ends.
[[nodiscard]] FileBytes decode_base64(std::string_view text);

}  // namespace pinocchio
