#include "hybrid/exchange/channels.h"

#include "hybrid/exchange/encode.h"
#include "hybrid/exchange/reflection_tiles.h"
#include "pinocchio/mask_image.h"

namespace pinocchio {
namespace {

std::size_t bytes_of(glm::ivec2 texels, const gl::PixelFormat& format) {
  return static_cast<std::size_t>(texels.x) * static_cast<std::size_t>(texels.y) * format.bytes;
}

ChannelLayout whole(Channel channel, const gl::PixelFormat& texel, glm::ivec2 texels) {
  return {channel, texel, texels, bytes_of(texels, texel)};
}

ChannelLayout mask_layout(const Settings& s, glm::ivec2 size) {
  const glm::ivec2 samples = scaled_size(size, s.mask_scale);
  return whole(Channel::mask, gl::kR8Ui, {MaskImage::row_bytes_for(samples.x, s.mask_bits), samples.y});
}

// In tiles it ends in a texture of whole tiles, and an index travels before them.
ChannelLayout reflection_layout(const Settings& s, glm::ivec2 size) {
  const glm::ivec2 samples = scaled_size(size, s.reflection_scale);
  const auto [pixel, texels] = texel_format(s.reflection);
  if (!s.tiles) return whole(Channel::reflection, pixel, {samples.x * texels, samples.y});
  const glm::ivec2 padded = tile_columns_rows(samples) * kReflectionTile;
  return {Channel::reflection, pixel, {padded.x * texels, padded.y}, most_tile_bytes(samples, s.reflection)};
}

}  // namespace

std::vector<ChannelLayout> channels_of(const Settings& s, glm::ivec2 size) {
  const bool raster = s.visibility == Processor::gpu, on_gpu = s.composite == Processor::gpu;
  std::vector<ChannelLayout> channels;
  if (!s.traces() || !s.uses_gpu()) return channels;
  const gl::PixelFormat ids = id_format(s.id_bits).pixel;
  if (raster && !s.wide) channels.push_back(whole(Channel::ids, ids, size));
  if (raster && s.normals) channels.push_back(whole(Channel::normals, gl::kRgb8, size));
  if (raster && s.wide) channels.push_back(whole(Channel::gbuffer, gl::kRgba32Ui, size));
  if (raster && !on_gpu) channels.push_back(whole(Channel::phong, gl::kSrgb8, size));
  if (!raster && on_gpu) channels.push_back(whole(Channel::traced_ids, ids, size));
  if (on_gpu && s.mask_bits > 0) channels.push_back(mask_layout(s, size));
  if (on_gpu && s.reflects()) channels.push_back(reflection_layout(s, size));
  if (raster && !on_gpu) channels.push_back(whole(Channel::picture, gl::kR8, component_size(size)));
  return channels;
}

TrafficBytes traffic_of(const Settings& settings, glm::ivec2 size) {
  TrafficBytes traffic;
  for (const ChannelLayout& c : channels_of(settings, size))
    (goes_to_cpu(c.channel) ? traffic.to_cpu : traffic.to_gpu) += c.most_bytes;
  return traffic;
}

}  // namespace pinocchio
