#pragma once

#include <string>

#include "pinocchio/texture.h"

namespace pinocchio {

// A PNG file of the texture's texels. Throws EnvironmentError.
[[nodiscard]] std::string png_of(const Texture& texture);

}  // namespace pinocchio
