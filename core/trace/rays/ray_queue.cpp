#include "core/trace/rays/ray_queue.h"

#include <algorithm>

namespace pinocchio {
namespace {

constexpr std::size_t kFloatColumns = 9, kWordColumns = 2;

}  // namespace

void RayQueue::make_room(std::size_t rays, const ExtraColumns& extra) {
  size = 0;
  const std::size_t needed = rays + kQueuePad;
  const auto column_of = [needed](auto& column, bool wanted) {
    if (wanted && column.size() < needed) column = std::remove_cvref_t<decltype(column)>(2 * needed);
    return wanted ? column.data() : nullptr;
  };
  width = column_of(widths_, extra.width);
  density = column_of(densities_, extra.density);
  medium = column_of(media_, extra.medium);
  way = column_of(ways_, extra.way);
  if (needed <= room_) return;
  // Not a power of two apart: columns of one ray would compete for one set of the cache.
  constexpr std::size_t kLine = kCacheLine / sizeof(float);
  const std::size_t room = (std::max(needed, 2 * room_) + kLine - 1) / kLine * kLine + kLine;
  room_ = 0;  // in case the allocation fails
  floats_ = AlignedVector<float>(kFloatColumns * room);
  words_ = AlignedVector<std::uint32_t>(kWordColumns * room);
  room_ = room;
  float* column = floats_.data();
  for (auto* triple : {&origin, &direction, &light})
    for (float*& one : *triple) {
      one = column;
      column += room_;
    }
  pixel = words_.data();
  triangle = pixel + room_;
}

void RayQueue::make_more_room(std::size_t rays, const ExtraColumns& extra) {
  const std::size_t needed = size + rays + kQueuePad;
  if (needed <= room_ && (!extra.width || (width && widths_.size() >= needed)) &&
      (!extra.medium || (medium && media_.size() >= needed)))
    return;
  RayQueue larger;
  larger.make_room(2 * size + rays, extra);
  larger.size = size;
  for (auto columns : {&RayQueue::origin, &RayQueue::direction, &RayQueue::light})
    for (int axis = 0; axis < 3; ++axis) std::copy_n((this->*columns)[axis], size, (larger.*columns)[axis]);
  std::copy_n(pixel, size, larger.pixel);
  if (extra.width && width) std::copy_n(width, size, larger.width);
  if (extra.medium && medium) std::copy_n(medium, size, larger.medium);
  *this = std::move(larger);
}

void copy_ray(const RayQueue& from, std::size_t i, RayQueue& to, std::size_t k) {
  for (auto columns : {&RayQueue::origin, &RayQueue::direction, &RayQueue::light})
    for (int axis = 0; axis < 3; ++axis) (to.*columns)[axis][k] = (from.*columns)[axis][i];
  if (to.medium) to.medium[k] = from.medium[i];
  to.triangle[k] = from.triangle[i];
}

}  // namespace pinocchio
