#include "core/reference/reference.h"

#include <cassert>

#include "core/parallel/tiles.h"

namespace pinocchio {

void reference_picture(const Scene& scene, Workers& workers, const shared::ViewParams& view, int depth,
                       Image<std::uint32_t>& ids, MaskImage& mask, Image<glm::vec3>& reflection,
                       Image<glm::vec4>& color) {
  const auto casting = static_cast<int>(casting_lights(scene).size());
  assert(casting <= kMaxCastingLights);
  mask.resize(ids.size(), MaskImage::bits_for(casting));
  reflection = depth > 0 ? Image<glm::vec3>(ids.size()) : Image<glm::vec3>();
  color = Image<glm::vec4>(ids.size());

  const ReferenceTree tree(*scene.mesh);
  const ReferenceTracer tracer(scene, tree);
  const auto draw_pixel = [&](int x, int y) {
    const ReferenceTracer::Pixel pixel = tracer.pixel(view, x, y, depth);
    ids.at(x, y) = pixel.triangle;
    for (int slot = 0; slot < casting; ++slot)
      if (pixel.mask >> slot & 1u) mask.set_bit(x, y, slot);
    if (depth > 0) reflection.at(x, y) = pixel.reflection;
    color.at(x, y) = pixel.color;
  };
  const TileGrid grid(ids.size());  // a tile's row is whole bytes of the mask
  workers.for_each(grid.count(), [&](std::size_t i) { TileGrid::for_each_pixel(grid.tile(i), draw_pixel); });
}

}  // namespace pinocchio
