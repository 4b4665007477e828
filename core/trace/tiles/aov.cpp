#include "core/trace/tiles/aov.h"

#include <algorithm>
#include <span>
#include <type_traits>

#include "core/parallel/tiles.h"
#include "core/trace/view/ray_model.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"
#include "pinocchio/tracer.h"

namespace pinocchio {
namespace {

constexpr std::size_t kRays = as_size(TileGrid::kTileSize) * TileGrid::kTileSize;

// A thread's memory for a tile.
struct SeenTile {
  RayQueue rays;
  alignas(kCacheLine) float columns[kSeenColumns][kRays + kQueuePad];
};

std::span<float*> columns_in(float*& column) {
  return {&column, 1};
}
std::span<float*> columns_in(float* (&columns)[3]) {
  return columns;
}

// Calls use(array, columns, nothing) for each of kSeenLayers that is wanted.
template <class Use>
void for_each_layer(const FrameArrays& to, SeenColumns& seen, const Use& use) {
  const auto use_wanted = [&](const auto& layer) {
    if (to.*layer.array) use(to.*layer.array, columns_in(seen.*layer.columns), layer.nothing);
  };
  std::apply([&](const auto&... layers) { (use_wanted(layers), ...); }, kSeenLayers);
}

// Makes the rays of the pixels that see something.
void put_rays(glm::ivec2 size, const std::uint32_t* ids, std::size_t ids_width, RayQueue& rays) {
  rays.make_room(kRays);
  TileGrid::for_each_pixel({{0, 0}, size}, [&](int x, int y) {
    const std::uint32_t triangle = ids[as_size(y) * ids_width + as_size(x)];
    rays.pixel[rays.size] = as_uint32(y << kTileBits | x);
    rays.triangle[rays.size] = triangle;
    rays.size += triangle != kNoTriangle ? 1 : 0;
  });
}

}  // namespace

void write_visible_points(const VisibleScene& of, const PixelBox& tile, const std::uint32_t* ids,
                          std::size_t ids_width, const FrameArrays& to, std::size_t first,
                          std::size_t width) {
  const glm::ivec2 size = tile.size();
  static thread_local SeenTile memory;
  SeenColumns seen;
  std::size_t used = 0;
  for_each_layer(to, seen, [&](auto* values, std::span<float*> columns, const auto& nothing) {
    for (float*& column : columns) column = memory.columns[used++];
    for (int y = 0; y < size.y; ++y) std::fill_n(values + first + as_size(y) * width, size.x, nothing);
  });

  RayQueue& rays = memory.rays;
  put_rays(size, ids, ids_width, rays);
  if (rays.size == 0) return;
  if (of.model)
    of.model->fill(tile.lo, kTileBits, rays);
  else
    of.steps.camera_rays(of.view, tile.lo, rays);
  Footprint footprint;
  if (of.filter_textures)
    footprint = of.model ? of.model->footprint((tile.lo + tile.hi) / 2, 1.0f) : Footprint::of_camera(of.view);
  Bounce at;
  at.scene = of.arrays;
  at.footprint = &footprint;
  of.steps.visible_points(at, of.model ? of.model->depth_axis() : view_axis(of.view), rays, seen);

  for_each_layer(to, seen, [&]<class Value>(Value* values, std::span<float*> columns, const Value&) {
    for (std::size_t i = 0; i < rays.size; ++i) {
      const std::uint32_t x = rays.pixel[i] & (TileGrid::kTileSize - 1), y = rays.pixel[i] >> kTileBits;
      Value& value = values[first + y * width + x];
      if constexpr (std::is_same_v<Value, float>) {
        value = columns[0][i];
      } else {
        value = {columns[0][i], columns[1][i], columns[2][i]};
      }
    }
  });
}

void write_visible_lines(const VisibleScene& of, const Image<std::uint32_t>& ids, int y0, int y1,
                         const FrameArrays& to, std::size_t first) {
  const glm::ivec2 size{ids.width(), y1 - y0};
  const auto width = as_size(size.x);
  const TileGrid grid(size);
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const PixelBox box = grid.tile(i), tile{box.lo + glm::ivec2(0, y0), box.hi + glm::ivec2(0, y0)};
    const std::size_t place = as_size(box.lo.y) * width + as_size(box.lo.x);
    write_visible_points(of, tile, &ids.at(tile.lo.x, tile.lo.y), width, to, first + place, width);
  }
}

SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view,
                             const Image<std::uint32_t>& ids, int y0, int y1, bool filter_textures) {
  const glm::ivec2 size{ids.width(), y1 - y0};
  SurfaceImages images{Image<float>(size), Image<glm::vec3>(size), Image<glm::vec3>(size),
                       Image<glm::vec3>(size)};
  const LaneMapsOf maps(mesh);
  const SceneArrays arrays = SceneArrays::of(mesh, maps);
  write_visible_lines({arrays, lane_steps(default_isa()), view, filter_textures}, ids, y0, y1,
                      arrays_of(images));
  return images;
}

}  // namespace pinocchio
