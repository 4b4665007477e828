#include "core/trace/ray_offset.h"

namespace pinocchio {
namespace {

// What tracers without an error bound usually take.
constexpr float kFixedLength = 1e-4f;  // scene units
constexpr float kShareOfDiagonal = 1e-5f;

}  // namespace

std::string_view offset_method_name(OffsetMethod method) {
  switch (method) {
    case OffsetMethod::fixed:
      return "fixed";
    case OffsetMethod::scaled:
      return "scaled";
    case OffsetMethod::error_bound:
      break;
  }
  return "error-bound";
}

std::optional<OffsetMethod> parse_offset_method(std::string_view name) {
  for (const OffsetMethod method : kOffsetMethods)
    if (name == offset_method_name(method)) return method;
  return std::nullopt;
}

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
