// A finished frame, as its sink sees it.

#include "hybrid/engine/engine_parts.h"
#include "hybrid/engine/frame_slot.h"
#include "hybrid/exchange/encode.h"
#include "hybrid/passes/passes.h"

namespace pinocchio {
namespace {

// Counts the pixels that the composite marked (composite.frag), and makes them opaque as they are.
std::size_t close_holes(Image<glm::vec4>& color) {
  constexpr float kHole = 1.0f - 0x1p-11f;
  std::size_t holes = 0;
  for (glm::vec4& pixel : color.pixels())
    if (pixel.a == kHole) {
      pixel.a = 1.0f;
      ++holes;
    }
  return holes;
}

// Where nothing is seen, mirrored light has travelled with what the shadow catcher lost.
void remove_lost(const Image<std::uint32_t>& ids, Image<glm::vec3>& reflection) {
  for (std::size_t i = 0; i < ids.pixels().size(); ++i)
    if (ids[i] == kNoTriangle) reflection[i] = glm::vec3(0.0f);
}

// Brings the ids to the CPU where they did not travel.
void read_ids(FrameSlot& frame) {
  if (frame.answered) return;  // they came for the CPU
  ChannelBuffer& buffer = frame[Channel::ids];
  frame.engine.enter([&] {
    buffer.back.start(buffer.target);
    fit(frame.ids, buffer.target.size());
    channel_row(Channel::ids).decode(buffer.back.open(), frame.request.settings, frame);
    buffer.back.close();
  });
}

}  // namespace

const FrameRequest& Frame::request() const {
  return slot_.request;
}

FrameRecord& Frame::record() const {
  return slot_.record;
}

const gl::Texture& Frame::texture() const {
  if (slot_.request.settings.uses_gpu()) return slot_.picture.color();
  if (slot_.is_shown) return slot_.shown;
  slot_.engine.enter([this] {
    (void)slot_.engine.gpu();
    const StageTimer timer(slot_.record, Stage::upload);
    slot_.release_unused();
    fit(slot_.shown, slot_.color.size(), gl::kRgba32F);
    slot_.picture_up.send(std::as_bytes(slot_.color.pixels()), slot_.shown);
  });
  slot_.is_shown = true;
  return slot_.shown;
}

unsigned Frame::texture_name() const {
  return texture().name();
}

const Image<glm::vec4>& Frame::color(Image<glm::vec4>& memory) const {
  if (!slot_.request.settings.uses_gpu()) return slot_.color;
  read_color(memory);
  return memory;
}

void Frame::read_color(Image<glm::vec4>& color) const {
  const Settings& s = slot_.request.settings;
  if (!s.uses_gpu()) {
    color = slot_.color;
    return;
  }
  if (slot_.picture_was_packed() && s.spp > 1) return slot_.copy_unpacked(color);
  const StageTimer timer(slot_.record, Stage::present);
  fit(color, slot_.picture.size());
  slot_.engine.enter([&] {
    slot_.picture_back.start(slot_.picture);
    unpack_picture(slot_.picture_back.open(), color);
    slot_.picture_back.close();
  });
}

FrameResult Frame::read() const {
  const Settings& s = slot_.request.settings;
  FrameResult result;
  read_color(result.color);
  if (slot_.record.age_frames > 0) result.holes = close_holes(result.color);
  read_ids(slot_);
  result.ids = slot_.ids;
  const glm::ivec2 size = slot_.ids.size();
  if (slot_.answered && s.mask_bits > 0)
    result.mask = s.mask_scale == 1 ? slot_.mask : enlarged(slot_.mask, s.mask_scale, size);
  if (slot_.answered && s.reflects())
    result.reflection =
        s.reflection_scale == 1 ? slot_.reflection : enlarged(slot_.reflection, s.reflection_scale, size);
  if (!result.reflection.empty() && slot_.options.catcher_height && s.uses_gpu())
    remove_lost(result.ids, result.reflection);
  result.scene = slot_.request.scene;
  result.view = slot_.request.view;
  result.settings = s;
  result.record = slot_.record;
  return result;
}

}  // namespace pinocchio
