#pragma once

#include <algorithm>
#include <type_traits>

#include "pinocchio/frame_arrays.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"
#include "pinocchio/surface_images.h"

namespace pinocchio {

// A frame's layers as images; no reflection: it is 0.
struct LayerImages {
  Image<glm::vec4> color{};
  Image<std::uint32_t> ids{};
  MaskImage mask{};
  Image<glm::vec3> reflection{};
  SurfaceImages surfaces{};

  // All of their lines, to the arrays that are wanted.
  void write(const FrameArrays& to) const {
    const auto copy = [&](const auto& image, auto* values) {
      if (!values) return;
      if (image.empty())
        std::fill_n(values, ids.pixels().size(), std::remove_reference_t<decltype(*values)>(0));
      std::ranges::copy(image.pixels(), values);
    };
    copy(color, to.color);
    copy(ids, to.ids);
    copy(reflection, to.reflection);
    copy(surfaces.z_eye, to.depth);
    copy(surfaces.p_world, to.position);
    copy(surfaces.n_shading, to.normal);
    copy(surfaces.albedo, to.albedo);
    const auto width = static_cast<std::size_t>(ids.width());
    for (int y = 0; to.mask && y < ids.height(); ++y)
      mask.copy_row(0, y, width, to.mask_bytes,
                    to.mask + static_cast<std::size_t>(y) * width * to.mask_bytes);
  }
};

}  // namespace pinocchio
