#pragma once

#include "pinocchio/mesh.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// Fills in texture.smaller_levels; colour is averaged in linear light.
void make_smaller_levels(Texture& texture, bool is_color);

// The same for all textures that maps interpolate and that have no levels yet, on all of the machine's
// threads. Phase "textures".
void make_smaller_levels(MeshData& mesh, Progress* progress);

}  // namespace pinocchio
