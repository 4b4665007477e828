// PNG files of linear pictures.
#pragma once

#include <filesystem>

#include "python/src/support/convert.h"

namespace pinocchio::python {

// The bytes of a file as a screen shows the picture: sRGB, 8 bits, `exposure`: stops brighter. `opaque`:
// something is seen everywhere, and alpha is 1; else alpha is straight.
[[nodiscard]] nb::bytes png_of(const Image<glm::vec4>& color, float exposure, bool opaque);
// Writes a file whole or not at all. Throws Error.
void write_bytes(const std::filesystem::path& path, const nb::bytes& bytes);

}  // namespace pinocchio::python
