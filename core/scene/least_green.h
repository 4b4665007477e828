#pragma once

#include "pinocchio/texture.h"

namespace pinocchio {

// Sets texture.least_green from its texels. Textures with a side below 64 texels have none.
void find_least_green(Texture& texture);

}  // namespace pinocchio
