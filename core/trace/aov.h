#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/trace/lane_steps.h"
#include "core/trace/shared.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/image.h"
#include "pinocchio/mesh.h"
#include "pinocchio/surface_images.h"

namespace pinocchio {

// Whose visible points are asked for.
struct VisibleScene {
  const Mesh& mesh;
  const LaneSteps& steps;
  const shared::ViewParams& view;
  bool filter_textures = true;
};

// What each pixel of a tile sees, from the triangles at `ids`, whose lines are `ids_width` apart, to those of
// the surfaces' arrays that are wanted: from place `first` on, lines `width` apart. `tile`: the view's
// pixels, no more than a TileGrid's.
void write_visible_points(const VisibleScene& of, const PixelBox& tile, const std::uint32_t* ids,
                          std::size_t ids_width, const FrameArrays& to, std::size_t first, std::size_t width);

// Of the lines [y0, y1).
[[nodiscard]] SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view,
                                           const Image<std::uint32_t>& ids, int y0, int y1,
                                           bool filter_textures = true);

}  // namespace pinocchio
