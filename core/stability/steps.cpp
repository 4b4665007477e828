#include "core/stability/steps.h"

#include "core/simd/lanes_scalar.h"

// The scalar kernel's text under a name of its own, so that its walk can be given other leaves.
namespace pinocchio::counting {
using namespace pinocchio::scalar;
}
#define PINOCCHIO_LANES counting
#include "core/trace/kernel.h"

namespace pinocchio::stability {

Steps steps_of(const BspTree& tree, const Ray& ray) {
  Steps steps;
  counting::Packet packet;
  const glm::vec3 &o = ray.origin, &d = ray.direction;
  packet.load({{&o.x, &o.y, &o.z}, {&d.x, &d.y, &d.z}, &ray.t_max}, 0, 1);
  counting::for_each_octant(packet, packet.living, [&](const counting::Course& course, scalar::Mask lanes) {
    counting::walk(tree, packet, course, lanes, packet.t_max, [&](const BspNode& leaf, scalar::Mask) {
      ++steps.leaves;
      steps.triangle_tests += leaf.reference_count();
    });
  });
  return steps;
}

}  // namespace pinocchio::stability
