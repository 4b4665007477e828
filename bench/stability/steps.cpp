#include "bench/stability/steps.h"

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
  counting::Group<1> one;
  const glm::vec3 &o = ray.origin, &d = ray.direction;
  one.packets[0].load({{&o.x, &o.y, &o.z}, {&d.x, &d.y, &d.z}, &ray.t_max}, 0, 1);
  const scalar::Float t_best[1] = {one.packets[0].t_max};
  counting::for_each_octant(one, [&](const bool(&negative)[3], const scalar::Mask(&lanes)[1]) {
    counting::walk(tree, one, negative, lanes, t_best, [&](const BspNode& leaf, const unsigned(&)[1]) {
      ++steps.leaves;
      steps.triangle_tests += leaf.reference_count();
    });
  });
  return steps;
}

}  // namespace pinocchio::stability
