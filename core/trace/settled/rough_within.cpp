#include "core/trace/settled/rough_within.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/shade/gltf_surface.h"
#include "core/shade/lane_maps.h"
#include "core/shade/shared.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr int kSquareSide = Texture::kGreenSide;

// Squares that are looked at for one answer. A look-up takes about a nanosecond.
constexpr std::size_t kMostSquares = std::size_t{1} << 12;

// Texels. Longer footprints see almost nothing of what a texture shows.
constexpr int kLongest = 128;

// Further away, coordinates are rounded by more than a quarter of a texel.
constexpr double kFar = 0x1p22;

// How far from a point look-ups of a footprint reach, texels, if it is a power of two or shorter: half of it,
// and one and a half texels of its coarser level (all_green in lanes/texture.h). Sides of at least 64 texels
// that are no powers of two make a level's texels up to 1.13 times as large, from 32 texels on up to twice.
int reach_of(int footprint) {
  return as_int(std::ceil(0.5 * footprint + 1.5 * (footprint <= 16 ? 1.13 : 2.0) * footprint + 1.0));
}

int wrapped(int texel, int count, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(texel, 0, count - 1);
  const int period = wrap == Wrap::mirror ? 2 * count : count;
  const int at = (texel % period + period) % period;
  return at < count ? at : period - 1 - at;
}

// Squares along a side, of texels that are at most `apart` from each other: the first and the last, and some
// between, of those that coordinates from `lo` to `hi` name, and of those so much further.
std::vector<int> squares_of(double lo, double hi, double further, int apart, int count, Wrap wrap) {
  if (wrap == Wrap::clamp) {
    lo = std::clamp(lo, 0.0, count - 1.0);
    hi = std::clamp(hi, 0.0, count - 1.0);
  }
  const int first = static_cast<int>(std::floor(lo - further));
  int last = static_cast<int>(std::floor(hi + further));
  if (wrap != Wrap::clamp) last = std::min(last, first + 2 * count);  // all of a mirrored one
  std::vector<int> squares;
  for (int texel = first; texel < last; texel += apart)
    squares.push_back(wrapped(texel, count, wrap) / kSquareSide);
  squares.push_back(wrapped(last, count, wrap) / kSquareSide);
  return squares;
}

// How a triangle lies on a texture, texels of its largest level.
struct OnTexture {
  glm::dvec2 at[3];        // the part's corners
  double texels_per_unit;  // at most, for a step across the triangle

  OnTexture(const Mesh& mesh, const TextureUse& use, glm::ivec2 size, std::uint32_t triangle,
            const TrianglePart& part) {
    const std::vector<glm::vec2>& texcoords = texcoords_of(mesh, use);
    const glm::uvec3& corners = mesh.triangles[triangle];
    glm::dvec2 uv[3];
    glm::dvec3 p[3];
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 t(texcoords[corners[i]]);
      uv[i] = glm::dvec2(size) * (glm::dmat3x2(use.uv_from_texcoord) * glm::dvec3(t, 1.0));
      p[i] = glm::dvec3(mesh.positions[corners[i]]);
    }
    for (std::size_t i = 0; i < 3; ++i) at[i] = part[i].x * uv[0] + part[i].y * uv[1] + part[i].z * uv[2];
    texels_per_unit = largest_stretch(p[1] - p[0], p[2] - p[0], uv[1] - uv[0], uv[2] - uv[0]);
  }

 private:
  // The largest singular value of the map that takes two edges to their pictures.
  static double largest_stretch(const glm::dvec3& ab, const glm::dvec3& ac, const glm::dvec2& to_ab,
                                const glm::dvec2& to_ac) {
    const double bb = glm::dot(ab, ab), bc = glm::dot(ab, ac), cc = glm::dot(ac, ac);
    const double area = bb * cc - bc * bc;
    // J Jt = T (Et E)^-1 Tt, for edges E and their pictures T.
    const glm::dmat2 inverse = glm::dmat2(cc, -bc, -bc, bb) / area, to(to_ab, to_ac);
    const glm::dmat2 square = to * inverse * glm::transpose(to);
    const double half = 0.5 * (square[0][0] + square[1][1]);
    const double off = std::hypot(0.5 * (square[0][0] - square[1][1]), square[0][1]);
    return std::sqrt(half + off);
  }
};

// The greens in a part of a texture, and around it.
class Greens {
 public:
  Greens(const Texture& texture, const TextureUse& use, const OnTexture& triangle)
      : texture_(texture), use_(use) {
    lo_ = glm::min(glm::min(triangle.at[0], triangle.at[1]), triangle.at[2]) - 1.0;
    hi_ = glm::max(glm::max(triangle.at[0], triangle.at[1]), triangle.at[2]) + 1.0;
  }

  // The longest footprint, texels, for which all are at least that.
  [[nodiscard]] double longest_footprint(double least) const {
    double longest = 0.0;
    if (!(-kFar < lo_.x && -kFar < lo_.y && hi_.x < kFar && hi_.y < kFar)) return longest;
    for (int footprint = 1; footprint <= kLongest && are_at_least(least, reach_of(footprint)); footprint *= 2)
      longest = footprint;
    return longest;
  }

 private:
  // Whether those are that are so many texels away, or nearer; false where too many would have to be read.
  [[nodiscard]] bool are_at_least(double least, int texels) const {
    int reach = kSquareSide, byte = 0;  // of each square that is looked at
    while (2 * reach <= texels && byte + 1 < Texture::kGreenReaches) {
      reach *= 2;
      ++byte;
    }
    const double further = texels - reach;
    const glm::ivec2 size = texture_.size();
    const std::vector<int> columns = squares_of(lo_.x, hi_.x, further, 2 * reach, size.x, use_.wrap_u);
    const std::vector<int> rows = squares_of(lo_.y, hi_.y, further, 2 * reach, size.y, use_.wrap_v);
    if (columns.size() * rows.size() > kMostSquares) return false;
    const auto squares = as_size((size.x + kSquareSide - 1) / kSquareSide);
    return std::ranges::all_of(rows, [&](int row) {
      return std::ranges::all_of(columns, [&](int column) {
        const std::uint32_t found = texture_.least_green[as_size(row) * squares + as_size(column)];
        return least <= as_float(found >> 8 * byte & 0xffu);
      });
    });
  }

  const Texture& texture_;
  const TextureUse& use_;
  glm::dvec2 lo_, hi_;
};

const MaterialMaps* maps_of(const Mesh& mesh, const Material& m) {
  return m.maps < 0 ? nullptr : &mesh.maps[as_size(m.maps)];
}

// The texture that decides where the material mirrors; null: it is not one alone.
const Texture* deciding_texture(const Mesh& mesh, const Material& m) {
  const MaterialMaps* const maps = maps_of(mesh, m);
  if (!maps || !roughness_decides(*maps) || maps->blends() || !is_readable(mesh, maps->metallic_roughness))
    return nullptr;
  const Texture& texture = mesh.textures[as_size(maps->metallic_roughness.texture)];
  return texture.least_green.empty() ? nullptr : &texture;
}

}  // namespace

bool may_be_rough(const Mesh& mesh, const Material& m) {
  return !may_show_beyond(m, maps_of(mesh, m)) || deciding_texture(mesh, m);
}

float rough_within(const Mesh& mesh, std::uint32_t triangle, const TrianglePart& part) {
  const Material& m = mesh.materials[mesh.triangle_materials[triangle]];
  if (!may_show_beyond(m, maps_of(mesh, m))) return std::numeric_limits<float>::infinity();
  const Texture* const texture = deciding_texture(mesh, m);
  if (!texture) return 0.0f;
  const MaterialMaps& maps = *maps_of(mesh, m);
  const OnTexture on(mesh, maps.metallic_roughness, texture->size(), triangle, part);
  const double least = 255.0 * 1.00001 * shared::kRoughestMirror / maps.surface.roughness;
  const Greens greens(*texture, maps.metallic_roughness, on);
  const double longest = 0.99 * greens.longest_footprint(least) / on.texels_per_unit;
  return longest > 0.0 ? static_cast<float>(longest) : 0.0f;  // not a number: the triangle is a line
}

}  // namespace pinocchio
