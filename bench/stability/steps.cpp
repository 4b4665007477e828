#include "bench/stability/steps.h"

// The scalar kernel's text in another namespace, so that its walk can have other leaves.
#define PINOCCHIO_LANES counting
namespace pinocchio::counting {
inline constexpr int kWidth = 1;
}
#include "core/simd/lanes_scalar.h"
#include "core/trace/walk/kernel.h"

namespace pinocchio::stability {

Steps steps_of(const BspTree& tree, const Ray& ray) {
  Steps steps;
  counting::Group<1> one;
  const glm::vec3 &o = ray.origin, &d = ray.direction;
  one.packets[0].load({{&o.x, &o.y, &o.z}, {&d.x, &d.y, &d.z}, &ray.t_max}, 0, 1);
  const counting::Float t_best[1] = {one.packets[0].t_max};
  counting::for_each_octant(one, [&](const bool(&negative)[3], const counting::Mask(&lanes)[1]) {
    counting::walk(tree, one, counting::ExactPlanes{}, negative, lanes, t_best,
                   [&](const BspNode& leaf, const unsigned(&)[1]) {
                     ++steps.leaves;
                     steps.triangle_tests += leaf.reference_count();
                   });
  });
  return steps;
}

}  // namespace pinocchio::stability
