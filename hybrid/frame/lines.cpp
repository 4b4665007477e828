#include "hybrid/frame/lines.h"

#include <algorithm>

#include "core/parallel/workers.h"
#include "core/shade/lane_maps.h"
#include "core/trace/tiles/aov.h"
#include "core/trace/tiles/identities.h"
#include "core/trace/tiles/motion.h"
#include "core/trace/view/ray_model.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"
#include "pinocchio/layers.h"

namespace pinocchio {
namespace {

void write_surfaces(const FrameResult& frame, const View& view, int y0, int y1, const FrameArrays& to,
                    std::size_t first) {
  const std::optional<RayModel> model = RayModel::of(view);
  const Mesh& mesh = *frame.scene.mesh;
  const LaneMapsOf maps(mesh);
  const SceneArrays arrays = SceneArrays::of(mesh, maps);
  write_visible_lines({arrays, lane_steps(default_isa()), view_params(view), frame.settings.filter_textures,
                       model ? &*model : nullptr},
                      frame.ids, y0, y1, to, first);
}

// Calls body(y0, y1, place of the first pixel) for bands of lines, on all threads.
template <class Body>
void for_each_band(const FrameResult& frame, const Body& body) {
  constexpr int kLines = 16;  // a task
  const glm::ivec2 size = frame.ids.size();
  Workers workers(frame.settings.threads);
  workers.for_each(as_size((size.y + kLines - 1) / kLines), [&](std::size_t i) {
    const int y0 = as_int(i) * kLines;
    body(y0, std::min(y0 + kLines, size.y), as_size(y0) * as_size(size.x));
  });
}

}  // namespace

void write_lines(const FrameResult& frame, int y0, int y1, const FrameArrays& to, std::size_t first) {
  const auto width = as_size(frame.ids.width());
  const std::size_t begin = as_size(y0) * width, count = as_size(y1 - y0) * width;
  const auto copy = [&]<class Value>(const Image<Value>& image, Value* values) {
    if (!values) return;
    if (image.empty()) {
      std::fill_n(values + first, count, Value(0));
    } else {
      std::copy_n(&image[begin], count, values + first);
    }
  };
  copy(frame.color, to.color);
  copy(frame.ids, to.ids);
  copy(frame.reflection, to.reflection);
  if (count > 0) write_identities(frame.scene, {&frame.ids[begin], count}, to, first);
  for (std::size_t i = 0; to.mask && i < count; i += width)
    frame.mask.copy_row(0, y0 + as_int(i / width), width, to.mask_bytes,
                        to.mask + (first + i) * to.mask_bytes);
  if (!(to.wants_surfaces() || to.motion) || count == 0) return;
  View view = frame.view;
  view.jitter = glm::vec2(0.0f);
  if (to.motion)
    write_motion(*frame.scene.mesh, view, frame.motion.value_or(MotionTo{nullptr, view.camera}),
                 {{0, y0}, {frame.ids.width(), y1}}, &frame.ids[begin], width, to.motion, first, width);
  FrameArrays of_first = to;
  const auto copy_mean = [&](const Image<glm::vec3>& mean, glm::vec3* FrameArrays::*layer) {
    if (mean.empty() || !(to.*layer)) return;
    copy(mean, to.*layer);
    of_first.*layer = nullptr;
  };
  copy_mean(frame.mean_normal, &FrameArrays::normal);
  copy_mean(frame.mean_albedo, &FrameArrays::albedo);
  if (of_first.wants_surfaces()) write_surfaces(frame, view, y0, y1, of_first, first);
}

void write_sample_surfaces(const FrameResult& frame, SurfaceImages& to) {
  FrameArrays arrays;
  arrays.normal = to.n_shading.pixels().data();
  arrays.albedo = to.albedo.pixels().data();
  for_each_band(frame, [&](int y0, int y1, std::size_t first) {
    write_surfaces(frame, frame.view, y0, y1, arrays, first);
  });
}

void write_layers(const FrameResult& frame, const FrameArrays& to, std::size_t first) {
  if (!to.wants_surfaces() && !to.motion) return write_lines(frame, 0, frame.ids.height(), to, first);
  for_each_band(frame,
                [&](int y0, int y1, std::size_t place) { write_lines(frame, y0, y1, to, first + place); });
}

SurfaceImages surfaces_of(const FrameResult& frame) {
  const glm::ivec2 size = frame.ids.size();
  SurfaceImages all{Image<float>(size), Image<glm::vec3>(size), Image<glm::vec3>(size),
                    Image<glm::vec3>(size)};
  write_layers(frame, arrays_of(all));
  return all;
}

void unpack_mask(const FrameResult& frame, std::uint8_t* to, std::size_t bytes) {
  FrameArrays arrays;
  arrays.mask = to;
  arrays.mask_bytes = bytes;
  write_lines(frame, 0, frame.ids.height(), arrays);
}

}  // namespace pinocchio
