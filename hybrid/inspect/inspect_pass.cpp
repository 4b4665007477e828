#include "hybrid/inspect/inspect_pass.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "core/base/decimal.h"
#include "hybrid/engine/engine_parts.h"
#include "hybrid/exchange/encode.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The definition of shaders/inspect.frag that shows the layer: SHOW_IDS.
std::string definition_of(Layer view) {
  std::string name = "SHOW_" + std::string(layer_row(view).window.name);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
  return name;
}

void send(std::span<const std::byte> bytes, glm::ivec2 texels, const gl::PixelFormat& format,
          ChannelBuffer& to) {
  fit(to.texture, texels, format);
  to.up.send(bytes, to.texture);
}

std::string text_of(float value) {
  return decimal(as_double(value), 4);
}

std::string name_of_slot(int slot, const Scene& scene) {
  const std::vector<int> casting = casting_lights(scene);
  if (as_size(slot) >= casting.size()) return "slot " + std::to_string(slot) + ", no light's";
  const auto light = as_size(casting[as_size(slot)]);
  const std::string& name = scene.lights[light].name;
  return "slot " + std::to_string(slot) + ", light " + std::to_string(light) +
         (name.empty() ? "" : " '" + name + "'");
}

int casting_of(const FrameRequest& request) {
  return as_int(casting_lights(request.scene).size());
}

// The slots from `first` on, a multiple of eight; all of a mask with fewer.
MaskImage eight_slots(const MaskImage& mask, int first) {
  if (mask.bits() <= 8) return mask;
  MaskImage slots(mask.size(), 8);
  for (int y = 0; y < mask.size().y; ++y)
    for (int x = 0; x < mask.size().x; ++x) {
      const auto byte = static_cast<std::uint8_t>(mask.get(x, y, first / 32 * 32) >> first % 32);
      slots.set_row(x, y, {&byte, 1});
    }
  return slots;
}

std::string legend_of_range(int axes, const ChannelRange& range) {
  if (axes == 1) return ": black " + text_of(range.lo.x) + ", white " + text_of(range.hi.x);
  constexpr std::array<const char*, 3> kAxes{": red X", ", green Y", ", blue Z"};
  std::string text;
  for (int i = 0; i < axes; ++i)
    text += std::string(kAxes[as_size(i)]) + " from " + text_of(range.lo[i]) + " to " + text_of(range.hi[i]);
  return text;
}

std::string legend_of_delay(const std::string& in_time, const FrameRecord& record) {
  if (record.age_frames > 0)
    return "shadows and reflections of " + std::to_string(record.age_frames) +
           " frame(s) before, warped: yellow 1, orange 2, red more; pink: a hole, nothing older fits";
  const int late = record.latency_frames;
  return in_time +
         (late > 0 ? "; the whole picture is " + std::to_string(late) + " frame(s) late" : std::string());
}

}  // namespace

std::string missing(Layer view, int slot, const Settings& s, int casting_lights) {
  if (view == Layer::delay && !s.uses_gpu())
    return "mode raytrace: the CPU draws alone, nothing comes later than the rest";
  if (layer_row(view).window.traced && s.mask_bits == 0 && !s.reflects())
    return s.mask_bits.given ? "mode raster traces nothing: every light reaches everything"
                             : "this scene needs nothing traced: no light casts, nothing mirrors";
  if (view == Layer::mask && s.mask_bits == 0) return "no light casts shadows: there is no mask";
  const int slots = std::max<int>(s.mask_bits, casting_lights);
  if (view == Layer::mask && slot >= slots)
    return "the mask has " + std::to_string(slots) + " slot(s), counted from 0";
  if (view == Layer::reflection && !s.reflects())
    return "nothing mirrors or refracts: there is no reflection";
  return {};
}

std::string legend(Layer view, int slot, const Frame& frame, const ChannelRange& range) {
  const Settings& s = frame.request().settings;
  if (std::string why = missing(view, slot, s, casting_of(frame.request())); !why.empty()) return why;
  const std::string where =
      s.uses_gpu() && s.composite == Processor::cpu ? "; from the CPU, which has it alone (design 2)" : "";
  const LayerRow& row = layer_row(view);
  std::string text(row.window.legend);
  if (view == Layer::delay) return legend_of_delay(text, frame.record());
  if (view == Layer::mask) {
    text = name_of_slot(slot, frame.request().scene) + ": " + text;
    if (s.light_cutoff > 0.0f) text += "; black too where it is too faint for a ray";
  }
  return text + legend_of_range(row.window.ranged_axes, range) + (row.window.traced ? where : "");
}

InspectPass::InspectPass(Engine& engine)
    : engine_(engine), shading_(engine.parts().enter([&] { return engine.parts().gpu().programs; })) {}

const gl::Texture& InspectPass::draw(const Frame& frame, Layer view, int slot, const ChannelRange& range) {
  if (view == Layer::picture) return frame.texture();
  engine_.parts().enter([&] { draw_buffer(frame, view, slot, range); });
  return target_.color();
}

void InspectPass::draw_buffer(const Frame& frame, Layer view, int slot, const ChannelRange& range) {
  const FrameSlot& shown = frame.slot();
  const Settings& s = shown.request.settings;
  const FrameSlot* const of = shown.answer_of;
  const bool has_it =
      missing(view, slot, s, casting_of(shown.request)).empty() && (!layer_row(view).window.traced || of);
  ShadingPasses::Inspected what;
  if (has_it)
    what = {.definition = definition_of(view),
            .slot = slot,
            .age_frames = shown.record.age_frames,
            .range_lo = range.lo,
            .range_hi = range.hi};
  ShadingPasses::Traced traced;
  std::optional<OlderFrame> older;
  if (has_it && layer_row(view).window.traced) {
    if (s.composite == Processor::cpu || (view == Layer::mask && slot >= s.mask_bits)) {
      what.first_slot = slot / 8 * 8;
      traced = send_from_cpu(s.composite == Processor::cpu ? shown : *of, view, what.first_slot);
    } else {
      traced = of->answer_on_gpu();
    }
    if (of != &shown) traced.of = &older.emplace(of->ids_texture(), of->view, shared::Sampling{});
  }
  fit(target_, shown.size(), gl::kRgba16F);
  shading_.inspect(inputs_of(shown), traced, what, target_);
}

ShadingPasses::Inputs InspectPass::inputs_of(const FrameSlot& frame) {
  if (frame.request.settings.uses_gpu()) return frame.inputs();
  constexpr int kIdBits = 32;  // the CPU's
  send(std::as_bytes(frame.ids.pixels()), frame.ids.size(), id_format(kIdBits).pixel, ids_);
  lights_.update(frame.request.scene);
  return frame.inputs(*engine_.parts().gpu_mesh(frame.request.scene.mesh), lights_, ids_.texture, kIdBits);
}

ShadingPasses::Traced InspectPass::send_from_cpu(const FrameSlot& frame, Layer view, int first_slot) {
  ShadingPasses::Traced traced;
  const Image<glm::vec3>& reflection = frame.reflection;
  if (view == Layer::mask) {
    const MaskImage mask = eight_slots(frame.mask, first_slot);
    const ChannelTexture texture = packed_mask_texture(mask.bits(), mask.size());
    send(std::as_bytes(mask.bytes()), texture.texels, texture.texel, mask_);
    traced.mask = {&mask_.texture, mask.bits(), frame.request.settings.mask_scale};
  }
  if (view == Layer::reflection) {
    constexpr ReflectionFormat kFormat = ReflectionFormat::full;  // the CPU's
    const PackedTexels packed = packed_texels(kFormat, reflection.size());
    send(std::as_bytes(reflection.pixels()), packed.size, packed.texel, reflection_);
    traced.reflection = {&reflection_.texture, nullptr, kFormat, 1};
  }
  return traced;
}

}  // namespace pinocchio
