// The visibility pass on the GPU.
#include "hybrid/passes/passes.h"

namespace pinocchio {

void rasterise(GpuPasses& gpu, FrameSlot& frame) {
  const Settings& s = frame.request.settings;
  const View& view = frame.request.view;
  frame.raster_timer.begin();
  fit(frame[Channel::ids].target, frame.size(), channel_row(Channel::ids).texture(s, frame.size()).texel,
      true);
  gpu.visibility.draw(*frame.mesh, frame.view, view.size, s.id_bits, frame.options.backfaces,
                      frame[Channel::ids].target);
  for (const ChannelLayout& c : frame.layout) {
    gl::Framebuffer& target = frame[c.channel].target;
    if (goes_to_cpu(c.channel) && c.channel != Channel::ids) fit(target, c.texels, c.texel);
    if (c.channel == Channel::normals) gpu.shading.normals(frame.inputs(), target);
    if (c.channel == Channel::gbuffer) gpu.shading.gbuffer(frame.inputs(), target);
    if (c.channel == Channel::phong) gpu.shading.composite(frame.inputs(), LightSet::free, {}, target);
  }
  frame.raster_timer.end();
}

}  // namespace pinocchio
