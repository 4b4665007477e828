#include "core/trace/tiles/identities.h"

#include "pinocchio/conversion.h"
#include "pinocchio/nodes.h"
#include "pinocchio/ray.h"

namespace pinocchio {
namespace {

std::uint32_t primitive_of(const Scene& scene, std::uint32_t triangle) {
  const int node = scene.nodes ? scene.nodes->node_of(triangle) : -1;
  return node < 0 ? triangle : triangle - scene.nodes->nodes[as_size(node)].first_triangle;
}

}  // namespace

void write_identities(const Scene& scene, std::span<const std::uint32_t> ids, const FrameArrays& to,
                      std::size_t first) {
  const auto fill = [&](std::uint32_t* values, auto of) {
    if (!values) return;
    for (std::size_t i = 0; i < ids.size(); ++i)
      values[first + i] = ids[i] == kNoTriangle ? kNoTriangle : of(ids[i]);
  };
  fill(to.objects, [&](std::uint32_t triangle) { return object_of(scene, triangle); });
  fill(to.materials, [&](std::uint32_t triangle) { return scene.mesh->triangle_materials[triangle]; });
  fill(to.primitives, [&](std::uint32_t triangle) { return primitive_of(scene, triangle); });
}

}  // namespace pinocchio
