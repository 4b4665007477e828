#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/shade/shared.h"
#include "core/trace/lanes/lane_steps.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/image.h"
#include "pinocchio/mesh.h"
#include "pinocchio/surface_images.h"

namespace pinocchio {

class RayModel;

// The scene and the view whose visible points are described.
struct VisibleScene {
  const SceneArrays& arrays;
  const LaneSteps& steps;
  const shared::ViewParams& view;
  bool filter_textures = true;
  const RayModel* model = nullptr;  // makes the camera's rays; null: `view` does
};

// Writes the wanted layers of the surfaces (depth, position, normal, albedo) for a tile's pixels, from the
// triangles at `ids`, whose lines are `ids_width` apart; to place `first` of the arrays, lines `width` apart.
// `tile`: pixels of the view, at most a TileGrid's tile.
void write_visible_points(const VisibleScene& of, const PixelBox& tile, const std::uint32_t* ids,
                          std::size_t ids_width, const FrameArrays& to, std::size_t first, std::size_t width);

// The same for the lines [y0, y1) of a picture, one after the other.
void write_visible_lines(const VisibleScene& of, const Image<std::uint32_t>& ids, int y0, int y1,
                         const FrameArrays& to, std::size_t first = 0);

// The arrays that the images' pixels are.
[[nodiscard]] inline FrameArrays arrays_of(SurfaceImages& images) {
  FrameArrays arrays;
  arrays.depth = images.z_eye.pixels().data();
  arrays.position = images.p_world.pixels().data();
  arrays.normal = images.n_shading.pixels().data();
  arrays.albedo = images.albedo.pixels().data();
  return arrays;
}

// The same as images.
[[nodiscard]] SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view,
                                           const Image<std::uint32_t>& ids, int y0, int y1,
                                           bool filter_textures = true);

}  // namespace pinocchio
