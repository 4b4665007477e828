#pragma once

#include "scenes/generator/mesh_builder.h"

namespace pinocchio {

// Water that mirrors (y = 0 is its level), an evening sky that closes over it and hills at its shore.
// Lights must stand nearer than 300 metres from the origin: the sky would hide them.
// `scale` multiplies the cells along each side; 1: about 7,000 triangles.
void add_lake(MeshBuilder& mesh, float scale);

}  // namespace pinocchio
