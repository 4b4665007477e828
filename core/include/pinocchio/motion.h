#pragma once

#include <memory>

#include "pinocchio/camera.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// Another frame of the same triangles, that of the next or the former moment: the layer `motion` leads from a
// picture's points to their places there.
struct MotionTo {
  std::shared_ptr<const Mesh> mesh;  // another pose. Null: nothing has moved
  Camera camera;
};

}  // namespace pinocchio
