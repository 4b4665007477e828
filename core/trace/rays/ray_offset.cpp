#include "pinocchio/ray_offset.h"

namespace pinocchio {
namespace {

// Usual values of tracers without an error bound.
constexpr float kFixedLength = 1e-4f;  // scene units
constexpr float kShareOfDiagonal = 1e-5f;

}  // namespace

RayOffset RayOffset::of(OffsetMethod method, const Bounds& scene) {
  switch (method) {
    case OffsetMethod::fixed:
      return {method, kFixedLength};
    case OffsetMethod::scaled:
      return {method, kShareOfDiagonal * scene.diagonal()};
    case OffsetMethod::error_bound:
      break;
  }
  return {};
}

}  // namespace pinocchio
