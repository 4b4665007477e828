#include "core/shade/lane_maps.h"

#include <algorithm>
#include <cstddef>

#include "core/image/tonemap.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

const Texture& texture_of(const Mesh& mesh, const TextureUse& use) {
  return mesh.textures[as_size(use.texture)];
}

bool share_place(const Mesh& mesh, const TextureUse& a, const TextureUse& b) {
  TextureUse same = b;
  same.texture = a.texture;
  const Texture &s = texture_of(mesh, a), &t = texture_of(mesh, b);
  return a == same && s.size() == t.size() && s.levels() == t.levels();
}

// The rows of kMapUses that a texture is read for.
struct TextureRead {
  const TextureUse* use;
  bool is_color;
  unsigned maps;
};

// Each texture once, whatever reads it; without alpha, which is read apart.
std::vector<TextureRead> textures_read(const Mesh& mesh, const MaterialMaps& maps) {
  std::vector<TextureRead> reads;
  for (std::size_t i = 0; i < kMapUses.size(); ++i) {
    const auto& [member, is_color, of_layers] = kMapUses[i];
    const TextureUse& use = maps.*member;
    if (member == &MaterialMaps::alpha || !is_readable(mesh, use)) continue;
    const auto same = std::ranges::find_if(
        reads, [&](const TextureRead& r) { return *r.use == use && r.is_color == kMapUses[i].is_color; });
    if (same != reads.end())
      same->maps |= 1u << i;
    else
      reads.push_back({&use, is_color, 1u << i});
  }
  return reads;
}

}  // namespace

const std::vector<glm::vec2>& texcoords_of(const Mesh& mesh, const TextureUse& use) {
  return use.uv_set == 1 ? mesh.texcoords1 : mesh.texcoords;
}

bool is_readable(const Mesh& mesh, const TextureUse& use) {
  return use.used() && !texcoords_of(mesh, use).empty();
}

TexturePlace texture_place(const Mesh& mesh, const TextureUse& use) {
  const Texture& texture = texture_of(mesh, use);
  TexturePlace place{};
  place.texcoords = texcoords_of(mesh, use).data();
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 2; ++row) place.uv_from_texcoord[column][row] = use.uv_from_texcoord[column][row];
  place.levels = texture.levels();
  for (int i = 0; i < place.levels; ++i) {
    const glm::ivec2 size = texture.blocks.size(i);
    place.level[i] = {as_uint32(texture.blocks.first(i)), as_float(size.x), as_float(size.y)};
  }
  place.wrap_u = use.wrap_u;
  place.wrap_v = use.wrap_v;
  place.nearest = use.nearest;
  return place;
}

LaneTexture lane_texture(const Mesh& mesh, const TextureUse& use, bool is_color, unsigned maps) {
  const Texture& t = texture_of(mesh, use);
  return {t.blocks.data(), is_color ? linear_from_srgb8().data() : nullptr, maps,
          t.least_green.empty() ? nullptr : t.least_green.data()};
}

LaneMapsOf::LaneMapsOf(const Mesh& mesh) {
  if (mesh.maps.empty()) return;
  // Reserved in full, as LaneMaps keep pointers into these vectors.
  const std::size_t most = mesh.maps.size() * kMapUses.size();
  places_.reserve(most);
  textures_.reserve(most);
  for (const MaterialMaps& maps : mesh.maps) {
    LaneMaps lane_maps{&maps, places_.data() + places_.size(), 0, nullptr};
    std::vector<TextureRead> reads = textures_read(mesh, maps);
    while (!reads.empty()) {
      TexturePlace& place = places_.emplace_back(texture_place(mesh, *reads.front().use));
      place.textures = textures_.data() + textures_.size();
      const TextureUse& first = *reads.front().use;
      std::erase_if(reads, [&](const TextureRead& r) {
        if (!share_place(mesh, first, *r.use)) return false;
        textures_.push_back(lane_texture(mesh, *r.use, r.is_color, r.maps));
        ++place.count;
        place.maps |= r.maps;
        return true;
      });
      ++lane_maps.count;
    }
    if (is_readable(mesh, maps.alpha) && maps.effective_alpha_mode() != AlphaMode::opaque) {
      TexturePlace& place = places_.emplace_back(texture_place(mesh, maps.alpha));
      place.textures = &textures_.emplace_back(lane_texture(mesh, maps.alpha, false, ~0u));
      place.count = 1;
      place.maps = ~0u;
      lane_maps.alpha = &place;
    }
    maps_.push_back(lane_maps);
  }
}

}  // namespace pinocchio
