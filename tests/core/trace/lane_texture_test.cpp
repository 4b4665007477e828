// Textures looked up by lanes (core/trace/lanes/texture.h) against one look-up at a time, which is the source
// that the GPU has too: the same bits.
#include <cmath>
#include <cstring>
#include <limits>

#include "bench/one_ray/map_lookup.h"
#include "core/simd/isas.h"
#include "tests/core/trace/lane_probe.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

Texture noise(const glm::ivec2& size, bool with_levels, Random& random) {
  Image<glm::u8vec4> texels(size);
  std::vector<glm::u8vec4> smaller;
  const auto texel = [&] {
    glm::u8vec4 t;
    for (int c = 0; c < 4; ++c) t[c] = static_cast<std::uint8_t>(random.between(0.0f, 255.99f));
    return t;
  };
  for (glm::u8vec4& t : texels.pixels()) t = texel();
  for (glm::ivec2 level = size; with_levels && level != glm::ivec2(1);) {
    level = glm::max(level / 2, glm::ivec2(1));
    for (int i = 0; i < level.x * level.y; ++i) smaller.push_back(texel());
  }
  return {"noise", {}, TexelBlocks(texels, smaller)};
}

// Whole numbers, edges, far outside, and how much a pixel sees: nothing to the whole texture, NaN and
// infinity.
void place(TexturePoints& points, unsigned lane, Random& random) {
  const auto coordinate = [&] {
    const float kind = random.between(0.0f, 8.0f);
    if (kind < 1.0f) return std::floor(random.between(-3.0f, 3.0f));
    if (kind < 2.0f) return random.between(-1e-9f, 1e-9f);
    if (kind < 3.0f) return random.between(-1e5f, 1e5f);
    return random.between(-2.5f, 2.5f);
  };
  const auto change = [&] {
    const float kind = random.between(0.0f, 16.0f);
    if (kind < 2.0f) return 0.0f;
    if (kind < 2.5f) return std::numeric_limits<float>::quiet_NaN();
    if (kind < 3.0f) return std::numeric_limits<float>::infinity();
    if (kind < 3.5f) return std::exp2(random.between(30.0f, 127.0f));
    return std::copysign(std::exp2(random.between(-12.0f, 4.0f)), random.between(-1.0f, 1.0f));
  };
  for (int axis = 0; axis < 2; ++axis) {
    points.uv[axis][lane] = coordinate();
    points.change_x[axis][lane] = change();
    points.change_y[axis][lane] = change();
  }
}

TEST(LaneTexture, SameBitsAsOneByOneAtEveryWidth) {
  Random random(11);
  Mesh mesh;
  for (const bool with_levels : {false, true})
    for (const glm::ivec2 size : {glm::ivec2(1), {7, 5}, {64, 16}, {1, 33}})
      mesh.textures.edit().push_back(noise(size, with_levels, random));
  std::vector<TextureUse> uses;
  for (int texture = 0; texture < static_cast<int>(mesh.textures.size()); ++texture)
    for (const Wrap wrap_u : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (const Wrap wrap_v : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const bool nearest : {false, true})
          uses.push_back({.texture = texture, .wrap_u = wrap_u, .wrap_v = wrap_v, .nearest = nearest});
  for (const Isa isa : supported_isas()) {
    const SampleTextures sample = lane_probe(isa).sample_textures;
    const unsigned width = lane_probe(isa).width;
    for (const TextureUse& use : uses)
      for (int round = 0; round < 20; ++round) {
        TexturePoints points{};
        for (unsigned lane = 0; lane < width; ++lane) place(points, lane, random);
        const unsigned lanes = round == 0 ? 1u : (1u << width) - 1u;
        TexturePlace at = texture_place(mesh, use);
        const LaneTexture textures[]{lane_texture(mesh, use, true, 1u), lane_texture(mesh, use, false, 2u)};
        at.textures = textures;
        at.count = 2;
        sample(at, lanes, 3u, points);
        TexturePlace of_data = at;
        of_data.textures = textures + 1;
        of_data.count = 1;
        const int channel = round % 4;
        float unfiltered[kMostLanes];
        lane_probe(isa).channel(of_data, lanes, channel, points, unfiltered);
        for (unsigned lane = 0; lane < width && lanes >> lane & 1u; ++lane) {
          const auto of = [&](const TexturePoints::Column(&columns)[2]) {
            return glm::vec2(columns[0][lane], columns[1][lane]);
          };
          const glm::vec4 point(shared::texels::sample_point(params_of(mesh, use), of(points.uv), false));
          ASSERT_EQ(std::memcmp(&unfiltered[lane], &point[channel], sizeof(float)), 0)
              << isa_name(isa) << " texture " << use.texture << " channel " << channel;
          for (const bool is_color : {true, false}) {
            const glm::vec4 one(shared::texels::sample_texture(
                params_of(mesh, use), {of(points.uv), of(points.change_x), of(points.change_y)}, is_color));
            const auto& texel = points.texel[is_color ? 0 : 1];
            for (int c = 0; c < (is_color ? 3 : 4); ++c) {
              ASSERT_TRUE(std::isfinite(one[c]));
              ASSERT_EQ(std::memcmp(&texel[c][lane], &one[c], sizeof(float)), 0)
                  << isa_name(isa) << " texture " << use.texture << " channel " << c << ": " << texel[c][lane]
                  << " " << one[c];
            }
          }
        }
      }
  }
}

// A texture transform of a file may be as large as a float can be.
TEST(LaneTexture, CoordinatesThatAreNotFinite) {
  Random random(12);
  Mesh mesh;
  mesh.textures.edit().push_back(noise({64, 16}, true, random));
  for (const Isa isa : supported_isas())
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (const float coordinate :
           {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
            std::numeric_limits<float>::quiet_NaN()}) {
        const TextureUse use{.texture = 0, .wrap_u = wrap, .wrap_v = wrap};
        TexturePoints points{};
        points.uv[0][0] = points.uv[1][0] = coordinate;
        TexturePlace at = texture_place(mesh, use);
        const LaneTexture textures[]{lane_texture(mesh, use, true, 1u), lane_texture(mesh, use, false, 2u)};
        at.textures = textures;
        at.count = 2;
        lane_probe(isa).sample_textures(at, 1u, 3u, points);
        for (const auto& texture : points.texel)
          for (int c = 0; c < 3; ++c) {
            EXPECT_GE(texture[c][0], 0.0f) << isa_name(isa) << " " << coordinate;
            EXPECT_LE(texture[c][0], 1.0f) << isa_name(isa) << " " << coordinate;
          }
        at.textures = textures + 1;
        at.count = 1;
        float unfiltered[kMostLanes];
        lane_probe(isa).channel(at, 1u, 3, points, unfiltered);
        EXPECT_GE(unfiltered[0], 0.0f) << isa_name(isa) << " " << coordinate;
        EXPECT_LE(unfiltered[0], 1.0f) << isa_name(isa) << " " << coordinate;
      }
}

}  // namespace
}  // namespace pinocchio
