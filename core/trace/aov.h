#pragma once

#include <cstdint>

#include "core/trace/shared.h"
#include "pinocchio/image.h"
#include "pinocchio/mesh.h"
#include "pinocchio/surface_images.h"

namespace pinocchio {

// Of the lines [y0, y1).
[[nodiscard]] SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view,
                                           const Image<std::uint32_t>& ids, int y0, int y1,
                                           bool filter_textures = true);

}  // namespace pinocchio
