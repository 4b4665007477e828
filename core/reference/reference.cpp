#include "core/reference/reference.h"

#include "core/parallel/tiles.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

ReferencePicture reference_render(const Scene& scene, const View& view, int depth, Workers& workers,
                                  Progress* progress, TraceOptions options) {
  const auto casting = as_int(casting_lights(scene).size());
  const glm::ivec2 size = view.box().size();
  const bool mirrors = depth > 0 || scene.environment;
  ReferencePicture picture{Image<std::uint32_t>(size), MaskImage(size, MaskImage::bits_for(casting)),
                           mirrors ? Image<glm::vec3>(size) : Image<glm::vec3>(), Image<glm::vec4>(size)};
  const ReferenceCamera camera(view);

  const ReferenceTree tree(*scene.mesh, progress);
  options.jitter = view.jitter;
  const ReferenceTracer tracer(scene, tree, options);
  const auto draw_pixel = [&](int x, int y) {
    const ReferenceTracer::Pixel pixel = tracer.pixel(camera, x, y, depth);
    picture.ids.at(x, y) = pixel.triangle;
    for (std::size_t slot = 0; slot < pixel.mask.size(); ++slot)
      if (pixel.mask[slot]) picture.mask.set_bit(x, y, as_int(slot));
    if (mirrors) picture.reflection.at(x, y) = pixel.reflection;
    picture.color.at(x, y) = pixel.color;
  };
  const TileGrid grid(size);  // a tile's row fills whole bytes of the mask
  const auto pixels = as_double(size.x) * size.y;
  workers.for_each(grid.count(), [&](std::size_t i) {
    const PixelBox tile = grid.tile(i);
    for (int y = tile.lo.y; y < tile.hi.y; ++y) {
      for (int x = tile.lo.x; x < tile.hi.x; ++x) draw_pixel(x, y);
      advance(progress, tile.size().x / pixels);
    }
  });
  return picture;
}

}  // namespace pinocchio
