#include "hybrid/inspect_pass.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "core/trace/view_params.h"
#include "hybrid/design.h"
#include "hybrid/formats.h"

namespace pinocchio {
namespace {

constexpr std::array<const char*, kBufferViewNames.size()> kDefinitions{
    "", "SHOW_IDS", "SHOW_NORMALS", "SHOW_MASK", "SHOW_REFLECTION", "SHOW_AGE"};

bool is_traced(BufferView view) {
  return view == BufferView::mask || view == BufferView::reflection || view == BufferView::age;
}

void send(std::span<const std::byte> bytes, glm::ivec2 texels, const gl::PixelFormat& format, Incoming& to) {
  fit(to.texture, texels, format);
  const std::span<std::byte> open = to.up.open(bytes.size());
  std::copy(bytes.begin(), bytes.end(), open.begin());
  to.up.send(to.texture);
}

std::string name_of_slot(int slot, const Scene& scene) {
  const std::vector<int> casting = casting_lights(scene);
  if (static_cast<std::size_t>(slot) >= casting.size())
    return "slot " + std::to_string(slot) + ", no light's";
  const auto light = static_cast<std::size_t>(casting[static_cast<std::size_t>(slot)]);
  const std::string& name = scene.lights[light].name;
  return "slot " + std::to_string(slot) + ", light " + std::to_string(light) +
         (name.empty() ? "" : " '" + name + "'");
}

std::string legend_of_age(const FrameRecord& record) {
  if (record.age_frames > 0)
    return "shadows and reflections of " + std::to_string(record.age_frames) +
           " frame(s) before, warped: yellow 1, orange 2, red more; pink: a hole, nothing older fits";
  const int late = record.latency_frames;
  return "green: shadows and reflections are the picture's own" +
         (late > 0 ? "; the whole picture is " + std::to_string(late) + " frame(s) late" : std::string());
}

}  // namespace

std::string missing(BufferView view, int slot, const Plan& plan) {
  if (view == BufferView::age && plan.mode == Mode::raytrace)
    return "mode raytrace: the CPU draws alone, nothing is older than the rest";
  if (is_traced(view) && !plan.traces())
    return plan.mode == Mode::raster ? "mode raster traces nothing: every light reaches everything"
                                     : "this scene needs nothing traced: no light casts, nothing mirrors";
  if (view == BufferView::mask && plan.mask_bits == 0) return "no light casts shadows: there is no mask";
  if (view == BufferView::mask && slot >= plan.mask_bits)
    return "the mask has " + std::to_string(plan.mask_bits) + " slot(s), counted from 0";
  if (view == BufferView::reflection && !plan.reflects())
    return "nothing mirrors or refracts: there is no reflection";
  return {};
}

std::string legend(BufferView view, int slot, const FrameRequest& request, const FrameRecord& record) {
  const Plan& plan = request.plan;
  if (std::string why = missing(view, slot, plan); !why.empty()) return why;
  const std::string where =
      plan.mode == Mode::hybrid && plan.design == 2 ? "; from the CPU, which has it alone (design 2)" : "";
  switch (view) {
    case BufferView::picture:
      return "the finished picture";
    case BufferView::ids:
      return "triangle ids, a colour each; dark: nothing is seen";
    case BufferView::normals:
      return "shading normals, world space: red X, green Y, blue Z, from -1 (dark) to 1 (bright)";
    case BufferView::mask:
      return name_of_slot(slot, request.scene->scene) +
             ": white lit, black in shadow, grey not asked (faces away, or nothing seen)" +
             (plan.least_light > 0.0f ? "; black too where it is too faint for a ray" : "") + where;
    case BufferView::reflection:
      return "mirrored and refracted light" + where;
    case BufferView::age:
      return legend_of_age(record);
  }
  return {};
}

InspectPass::InspectPass(std::shared_ptr<Programs> programs) : shading_(std::move(programs)) {}

const gl::Framebuffer& InspectPass::draw(const Flight& frame, BufferView view, int slot) {
  if (view == BufferView::picture) return frame.picture.target;
  const FrameRequest& request = frame.request;
  const bool has_it = missing(view, slot, request.plan).empty() && (!is_traced(view) || frame.answer_of);
  ShadingPasses::Inspected what;
  if (has_it) what = {kDefinitions[static_cast<std::size_t>(view)], slot, frame.record.age_frames};
  ShadingPasses::Traced traced;
  std::optional<OlderFrame> older;
  if (has_it && is_traced(view)) {
    traced = request.plan.design == 2 ? send_from_cpu(frame.mask, frame.reflection, view)
                                      : answer_on_gpu(*frame.answer_of);
    if (frame.answer_of != &frame)
      traced.of = &older.emplace(frame.answer_of->ids_texture(), frame.answer_of->view);
  }
  fit(target_, request.part.size(), gl::kRgba16F);
  shading_.inspect({*request.scene->gpu, frame.view, frame.ids_texture(), request.plan.id_bits}, traced, what,
                   target_);
  return target_;
}

const gl::Framebuffer& InspectPass::draw(const FrameRequest& request, const Picture& picture, BufferView view,
                                         int slot) {
  assert(view != BufferView::picture);
  constexpr int kIdBits = 32;  // as the CPU has them
  send(std::as_bytes(picture.ids.pixels()), picture.ids.size(), id_format(kIdBits).pixel, ids_);
  ShadingPasses::Inspected what;
  ShadingPasses::Traced traced;
  if (missing(view, slot, request.plan).empty()) {
    what = {kDefinitions[static_cast<std::size_t>(view)], slot, 0};
    traced = send_from_cpu(picture.mask, picture.reflection, view);
  }
  fit(target_, request.part.size(), gl::kRgba16F);
  const shared::ViewParams seen_from =
      view_params(request.camera, request.size, request.jitter, request.part.lo);
  shading_.inspect({*request.scene->gpu, seen_from, ids_.texture, kIdBits}, traced, what, target_);
  return target_;
}

ShadingPasses::Traced InspectPass::send_from_cpu(const MaskImage& mask, const Image<glm::vec3>& reflection,
                                                 BufferView view) {
  ShadingPasses::Traced traced;
  if (view == BufferView::mask) {
    send(std::as_bytes(mask.bytes()), {mask.row_bytes(), mask.size().y}, gl::kR8Ui, mask_);
    traced.mask = {&mask_.texture, mask.bits(), 1};
  }
  if (view == BufferView::reflection) {
    constexpr ReflectionFormat kFormat = ReflectionFormat::full;  // as the CPU has it
    send(std::as_bytes(reflection.pixels()), component_size(reflection.size()), texel_format(kFormat).pixel,
         reflection_);
    traced.reflection = {&reflection_.texture, nullptr, kFormat, 1};
  }
  return traced;
}

}  // namespace pinocchio
