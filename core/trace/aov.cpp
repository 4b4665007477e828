#include "core/trace/aov.h"

#include <algorithm>

#include "core/parallel/tiles.h"
#include "core/trace/view_params.h"
#include "pinocchio/tracer.h"

namespace pinocchio {
namespace {

constexpr std::size_t kRays = static_cast<std::size_t>(TileGrid::kTileSize) * TileGrid::kTileSize;

// A thread's memory for a tile.
struct SeenTile {
  RayQueue rays;
  alignas(kCacheLine) float columns[10][kRays + kQueuePad];

  // Columns for what `to` wants.
  SeenColumns wanted(const FrameArrays& to) {
    SeenColumns of;
    if (to.depth) of.depth = columns[0];
    for (int c = 0; c < 3; ++c) {
      if (to.position) of.position[c] = columns[1 + c];
      if (to.normal) of.normal[c] = columns[4 + c];
      if (to.albedo) of.albedo[c] = columns[7 + c];
    }
    return of;
  }
};

// A tile's lines in an array, if that is wanted: as they stand where nothing is hit.
template <class Value>
void clear(Value* to, const Value& nothing, glm::ivec2 size, std::size_t first, std::size_t width) {
  if (!to) return;
  for (int y = 0; y < size.y; ++y)
    std::fill_n(to + first + static_cast<std::size_t>(y) * width, size.x, nothing);
}

// The rays of the pixels that see something.
void put_rays(glm::ivec2 size, const std::uint32_t* ids, std::size_t ids_width, RayQueue& rays) {
  rays.make_room(kRays);
  TileGrid::for_each_pixel({{0, 0}, size}, [&](int x, int y) {
    const std::uint32_t triangle = ids[static_cast<std::size_t>(y) * ids_width + static_cast<std::size_t>(x)];
    rays.pixel[rays.size] = static_cast<std::uint32_t>(y << kTileBits | x);
    rays.triangle[rays.size] = triangle;
    rays.size += triangle != kNoTriangle ? 1 : 0;
  });
}

}  // namespace

void write_visible_points(const VisibleScene& of, const PixelBox& tile, const std::uint32_t* ids,
                          std::size_t ids_width, const FrameArrays& to, std::size_t first,
                          std::size_t width) {
  const glm::ivec2 size = tile.size();
  clear(to.depth, kInfinity, size, first, width);
  for (glm::vec3* const vectors : {to.position, to.normal, to.albedo})
    clear(vectors, glm::vec3(0.0f), size, first, width);

  static thread_local SeenTile memory;
  RayQueue& rays = memory.rays;
  put_rays(size, ids, ids_width, rays);
  if (rays.size == 0) return;
  of.steps.camera_rays(of.view, tile.lo, rays);
  const Footprint footprint = of.filter_textures ? Footprint::of_camera(of.view) : Footprint{};
  Bounce at;
  at.scene = SceneArrays::of(of.mesh);
  at.footprint = &footprint;
  const SeenColumns seen = memory.wanted(to);
  of.steps.see(at, view_axis(of.view), rays, seen);

  const auto vector = [](float* const(&columns)[3], std::size_t i) {
    return glm::vec3(columns[0][i], columns[1][i], columns[2][i]);
  };
  for (std::size_t i = 0; i < rays.size; ++i) {
    const std::uint32_t x = rays.pixel[i] & (TileGrid::kTileSize - 1), y = rays.pixel[i] >> kTileBits;
    const std::size_t place = first + y * width + x;
    if (to.depth) to.depth[place] = seen.depth[i];
    if (to.position) to.position[place] = vector(seen.position, i);
    if (to.normal) to.normal[place] = vector(seen.normal, i);
    if (to.albedo) to.albedo[place] = vector(seen.albedo, i);
  }
}

SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view,
                             const Image<std::uint32_t>& ids, int y0, int y1, bool filter_textures) {
  const glm::ivec2 size{ids.width(), y1 - y0};
  SurfaceImages images{Image<float>(size), Image<glm::vec3>(size), Image<glm::vec3>(size),
                       Image<glm::vec3>(size)};
  FrameArrays to;
  to.depth = images.z_eye.pixels().data();
  to.position = images.p_world.pixels().data();
  to.normal = images.n_shading.pixels().data();
  to.albedo = images.albedo.pixels().data();
  const VisibleScene of{mesh, lane_steps(default_isa()), view, filter_textures};
  const auto width = static_cast<std::size_t>(size.x);
  const TileGrid grid(size);
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const PixelBox box = grid.tile(i), tile{box.lo + glm::ivec2(0, y0), box.hi + glm::ivec2(0, y0)};
    write_visible_points(of, tile, &ids.at(tile.lo.x, tile.lo.y), width, to,
                         images.z_eye.index(box.lo.x, box.lo.y), width);
  }
  return images;
}

}  // namespace pinocchio
