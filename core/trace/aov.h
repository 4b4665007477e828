#pragma once

#include <cstdint>

#include "core/parallel/workers.h"
#include "core/trace/shared.h"
#include "pinocchio/image.h"
#include "pinocchio/mesh.h"
#include "pinocchio/surface_images.h"

namespace pinocchio {

[[nodiscard]] SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view, Workers& workers,
                                           const Image<std::uint32_t>& ids);

}  // namespace pinocchio
