#pragma once

#include "pinocchio/texture.h"

namespace pinocchio {

// Fills in texture.smaller_levels; colour is averaged in linear light.
void make_smaller_levels(Texture& texture, bool is_color);

}  // namespace pinocchio
