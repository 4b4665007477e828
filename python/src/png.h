// PNG files of linear pictures.
#pragma once

#include <filesystem>

#include <pinocchio/frame.h>

#include "python/src/support/convert.h"

namespace pinocchio::python {

// The bytes of a file as a screen shows the picture: sRGB, 8 bits, `exposure`: stops brighter. A colour
// behind the scene is shown as it is. Where something is seen everywhere alpha is 1, else it is straight.
[[nodiscard]] nb::bytes png_of(const FrameResult& frame, float exposure);
// Writes a file whole or not at all. Throws Error.
void write_bytes(const std::filesystem::path& path, const nb::bytes& bytes);

}  // namespace pinocchio::python
