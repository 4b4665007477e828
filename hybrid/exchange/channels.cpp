#include "hybrid/exchange/channels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "hybrid/exchange/encode.h"
#include "hybrid/exchange/reflection_tiles.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

bool raster(const Settings& s) {
  return s.visibility == Processor::gpu;
}

bool on_gpu(const Settings& s) {
  return s.composite == Processor::gpu;
}

using S = const Settings&;
using Bytes = std::span<const std::byte>;
using Writable = std::span<std::byte>;

ChannelTexture whole(const gl::PixelFormat& texel, glm::ivec2 texels) {
  const auto count = as_size(texels.x) * as_size(texels.y);
  return {.texel = texel, .texels = texels, .most_bytes = count * texel.bytes};
}

}  // namespace

// MaskImage's bytes are the texels' in a little-endian machine, as all are that we know of.
static_assert(std::endian::native == std::endian::little);
ChannelTexture packed_mask_texture(int bits, glm::ivec2 samples) {
  if (bits <= 8) return whole(gl::kR8Ui, {MaskImage::row_bytes_for(samples.x, bits), samples.y});
  return whole(bits == 16 ? gl::kR16Ui : bits == 32 ? gl::kR32Ui : gl::kRg32Ui, samples);
}

namespace {

ChannelTexture mask_texture(S s, glm::ivec2 size) {
  return packed_mask_texture(s.mask_bits, scaled_size(size, s.mask_scale));
}

// The slots that travel; the CPU's mask has all.
void encode_mask(CpuImages& from, S s, Workers&, Writable to) {
  const MaskImage& mask = from.mask;
  if (mask.bits() == s.mask_bits) {
    std::memcpy(to.data(), mask.bytes().data(), to.size());
    return;
  }
  const auto bytes = as_size(s.mask_bits / 8), width = as_size(mask.size().x);
  for (int y = 0; y < mask.size().y; ++y)
    mask.copy_row(0, y, width, bytes,
                  reinterpret_cast<std::uint8_t*>(to.data()) + as_size(y) * width * bytes);
}

ChannelTexture packed(ReflectionFormat format, glm::ivec2 pixels) {
  const PackedTexels packed = packed_texels(format, pixels);
  return whole(packed.texel, packed.size);
}

// With tiles: an index travels first, then the lit tiles; the texture is padded to whole tiles.
ChannelTexture reflection_texture(S s, glm::ivec2 size) {
  const glm::ivec2 samples = scaled_size(size, s.reflection_scale);
  if (!s.tiles) return packed(s.reflection, samples);
  const glm::ivec2 tiles = tile_columns_rows(samples);
  const PackedTexels padded = packed_texels(s.reflection, tiles * kReflectionTile);
  return {.texel = padded.texel,
          .texels = padded.size,
          .most_bytes = most_tile_bytes(samples, s.reflection),
          .tiles = tiles};
}

void encode_reflection(CpuImages& from, S s, Workers& workers, Writable to) {
  if (!s.tiles) return pack_radiance(from.reflection, s.reflection, workers, to);
  from.tiles = pack_tiles(from.reflection, from.black_tiles, s.reflection, workers, from.tile_index, to);
}

void decode_phong(Bytes bytes, S, CpuImages& to) {
  if (to.phong_srgb.size() != to.ids.size()) to.phong_srgb = Image<glm::u8vec3>(to.ids.size());
  std::ranges::copy(bytes, std::as_writable_bytes(to.phong_srgb.pixels()).begin());
}

// By channel.
constexpr std::array<ChannelRow, kChannelNames.size()> kRows{{
    {.channel = Channel::ids,
     .travels = [](S s) { return raster(s) && !s.wide; },
     .texture = [](S s, glm::ivec2 size) { return whole(id_format(s.id_bits).pixel, size); },
     .decode = [](Bytes bytes, S s, CpuImages& to) { unpack_ids(bytes, s.id_bits, to.ids); }},
    {.channel = Channel::normals,  // the slides send them; the tracer's hit points have their own
     .travels = [](S s) { return raster(s) && s.normals; },
     .texture = [](S, glm::ivec2 size) { return whole(gl::kRgb8, size); }},
    {.channel = Channel::gbuffer,
     .travels = [](S s) { return raster(s) && s.wide; },
     .texture = [](S, glm::ivec2 size) { return whole(gl::kRgba32Ui, size); },
     .decode = [](Bytes bytes, S, CpuImages& to) { unpack_gbuffer_ids(bytes, to.ids); }},
    {.channel = Channel::phong,
     .travels = [](S s) { return raster(s) && !on_gpu(s); },
     .texture = [](S, glm::ivec2 size) { return whole(gl::kSrgb8, size); },
     .decode = decode_phong},
    {.channel = Channel::traced_ids,
     .travels = [](S s) { return !raster(s) && on_gpu(s); },
     .texture = [](S s, glm::ivec2 size) { return whole(id_format(s.id_bits).pixel, size); },
     .encode = [](CpuImages& from, S s, Workers&, Writable to) { pack_ids(from.ids, s.id_bits, to); }},
    {.channel = Channel::mask,
     .travels = [](S s) { return on_gpu(s) && s.mask_bits > 0; },
     .texture = mask_texture,
     .encode = encode_mask},
    {.channel = Channel::reflection,
     .travels = [](S s) { return on_gpu(s) && s.reflects(); },
     .texture = reflection_texture,
     .encode = encode_reflection},
    {.channel = Channel::picture,
     .travels = [](S s) { return raster(s) && !on_gpu(s); },
     .texture = [](S, glm::ivec2 size) { return packed(ReflectionFormat::rgb8, size); },
     .encode = [](CpuImages& from, S, Workers& workers,
                  Writable to) { pack_srgb(from.unpacked, workers, to); }},
}};
static_assert([] {
  for (std::size_t i = 0; i < kRows.size(); ++i)
    if (as_size(kRows[i].channel) != i) return false;
  return true;
}());

}  // namespace

const ChannelRow& channel_row(Channel channel) {
  return kRows[as_size(channel)];
}

std::vector<ChannelLayout> channels_of(const Settings& s, glm::ivec2 size) {
  std::vector<ChannelLayout> channels;
  if (!s.traces() || !s.uses_gpu()) return channels;
  for (const ChannelRow& row : kRows)
    if (row.travels(s)) channels.push_back({row.texture(s, size), row.channel});
  return channels;
}

TrafficBytes traffic_of(const Settings& settings, glm::ivec2 size) {
  TrafficBytes traffic;
  for (const ChannelLayout& c : channels_of(settings, size))
    (goes_to_cpu(c.channel) ? traffic.to_cpu : traffic.to_gpu) += c.most_bytes;
  return traffic;
}

}  // namespace pinocchio
