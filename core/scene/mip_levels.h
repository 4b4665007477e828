#pragma once

#include "pinocchio/mesh.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// Moves the textures' texels to their blocks, with smaller levels where maps interpolate; colour is averaged
// in linear light. On all of the machine's threads. Phase "textures".
void finish_textures(MeshData& mesh, Progress* progress);

}  // namespace pinocchio
