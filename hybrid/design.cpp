#include "hybrid/design.h"

#include "core/trace/view_params.h"
#include "hybrid/formats.h"

namespace pinocchio {

void Design::draw_ids(Flight& frame) const {
  const FrameRequest& request = frame.request;
  frame.view = view_params(request.camera, request.size, request.jitter, request.part.lo);
  fit(frame.visibility.target, request.part.size(), id_format(request.plan.id_bits).pixel, true);
  passes_.visibility.draw(*request.scene->gpu, frame.view, request.size, request.plan.id_bits,
                          frame.visibility.target);
}

void Design::send_to_cpu(Flight& frame, Outgoing& picture, Transfer transfer) const {
  picture.back.start(picture.target);
  frame.record[transfer] = picture.back.bytes();
}

ShadingPasses::Inputs Design::inputs_of(const Flight& frame) const {
  return {*frame.request.scene->gpu, frame.view, frame.ids_texture(), frame.request.plan.id_bits};
}

void fit(gl::Framebuffer& target, glm::ivec2 size, const gl::PixelFormat& format, bool with_depth) {
  if (target.size() != size || target.color().format() != format)
    target = gl::Framebuffer(size, format, with_depth);
}

void fit(gl::Texture& texture, glm::ivec2 size, const gl::PixelFormat& format) {
  if (texture.size() != size || texture.format() != format) texture = gl::Texture(size, format);
}

}  // namespace pinocchio
