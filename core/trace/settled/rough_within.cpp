#include "core/trace/settled/rough_within.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/shade/gltf_surface.h"
#include "core/shade/shared.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr int kSquareSide = Texture::kGreenSide;

// Squares that are looked at for a part. A look-up takes about a nanosecond.
constexpr std::size_t kMostSquares = std::size_t{1} << 14;

// Further away, coordinates are rounded by more than a quarter of a texel.
constexpr double kFar = 0x1p22;

// The longest footprint, texels, whose look-ups stay within so many texels, which are a power of two or more
// than 40: `reach` in all_green of lanes/texture.h.
constexpr double longest_within(double texels) {
  return texels / 4.0;
}

int wrapped(int texel, int count, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(texel, 0, count - 1);
  const int period = wrap == Wrap::mirror ? 2 * count : count;
  const int at = (texel % period + period) % period;
  return at < count ? at : period - 1 - at;
}

// The squares along a side that hold the texels from `lo` to `hi`.
std::vector<int> squares_of(double lo, double hi, int count, Wrap wrap) {
  std::vector<int> squares;
  const int first = static_cast<int>(std::floor(lo)), last = static_cast<int>(std::floor(hi));
  for (int texel = first; texel <= std::min(last, first + 2 * count); ++texel)
    if (const int square = wrapped(texel, count, wrap) / kSquareSide;
        squares.empty() || squares.back() != square)
      squares.push_back(square);
  std::ranges::sort(squares);
  squares.erase(std::ranges::unique(squares).begin(), squares.end());
  return squares;
}

// How a triangle lies on a texture, texels of its largest level.
struct OnTexture {
  glm::dvec2 at[3];        // the part's corners
  double texels_per_unit;  // at most, for a step across the triangle

  OnTexture(const Mesh& mesh, const TextureUse& use, glm::ivec2 size, std::uint32_t triangle,
            const TrianglePart& part) {
    const std::vector<glm::vec2>& texcoords = use.uv_set == 1 ? mesh.texcoords1 : mesh.texcoords;
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

// Whether all greens in a part of a texture, and around it, are at least that.
class Greens {
 public:
  Greens(const Texture& texture, const TextureUse& use, const OnTexture& triangle, double least)
      : texture_(texture), use_(use), least_(least) {
    lo_ = glm::min(glm::min(triangle.at[0], triangle.at[1]), triangle.at[2]) - 1.0;
    hi_ = glm::max(glm::max(triangle.at[0], triangle.at[1]), triangle.at[2]) + 1.0;
    known_ = -kFar < lo_.x && -kFar < lo_.y && hi_.x < kFar && hi_.y < kFar;
  }

  // The longest footprint, texels, for which they are.
  [[nodiscard]] double longest_footprint() const {
    double longest = 0.0;
    if (!known_) return longest;
    const std::array<int, Texture::kGreenReaches> greens = least_greens(0.0);
    for (int k = 0; k < Texture::kGreenReaches; ++k) {
      if (greens[as_size(k)] < least_) return longest;
      longest = longest_within(as_float(kSquareSide << k));
    }
    constexpr double kReach = kSquareSide << (Texture::kGreenReaches - 1);
    for (double further = kReach; further < 16.0 * kReach; further *= 2.0) {
      if (least_greens(further).back() < least_) return longest;
      longest = longest_within(kReach + further);
    }
    return longest;
  }

 private:
  // The least within each reach of texels that are at most `further` away; 0 where there are too many.
  [[nodiscard]] std::array<int, Texture::kGreenReaches> least_greens(double further) const {
    std::array<int, Texture::kGreenReaches> least{};
    const glm::ivec2 size = texture_.size();
    const std::vector<int> columns = squares_of(lo_.x - further, hi_.x + further, size.x, use_.wrap_u),
                           rows = squares_of(lo_.y - further, hi_.y + further, size.y, use_.wrap_v);
    if (columns.size() * rows.size() > kMostSquares) return least;
    least.fill(255);
    const auto squares = as_size((size.x + kSquareSide - 1) / kSquareSide);
    for (const int row : rows) {
      for (const int column : columns) {
        const std::uint32_t found = texture_.least_green[as_size(row) * squares + as_size(column)];
        for (std::size_t k = 0; k < least.size(); ++k)
          least[k] = std::min(least[k], as_int(found >> 8 * k & 0xffu));
      }
      if ((further > 0.0 ? least.back() : least.front()) < least_) break;
    }
    return least;
  }

  const Texture& texture_;
  const TextureUse& use_;
  double least_;
  glm::dvec2 lo_, hi_;
  bool known_;
};

const MaterialMaps* maps_of(const Mesh& mesh, const Material& m) {
  return m.maps < 0 ? nullptr : &mesh.maps[as_size(m.maps)];
}

// Whether it mirrors, transmits or blends somewhere. The values of a material with maps are the most that it
// does.
bool may_show_beyond(const Mesh& mesh, const Material& m) {
  const MaterialMaps* const maps = maps_of(mesh, m);
  return m.reflects() || m.transmits() || m.fresnel || (maps && maps->blends());
}

// The texture that decides where the material mirrors; null: it is not one alone (surely_rough in
// lanes/maps.h).
const Texture* deciding_texture(const Mesh& mesh, const Material& m) {
  const MaterialMaps* const maps = maps_of(mesh, m);
  if (!maps || !maps->from_gltf || has_layers(*maps) || maps->surface.transmission > 0.0f || maps->blends())
    return nullptr;
  const TextureUse& use = maps->metallic_roughness;
  if (!use.used() || (use.uv_set == 1 ? mesh.texcoords1 : mesh.texcoords).empty()) return nullptr;
  const Texture& texture = mesh.textures[as_size(use.texture)];
  return texture.least_green.empty() ? nullptr : &texture;
}

}  // namespace

bool may_be_rough(const Mesh& mesh, const Material& m) {
  return !may_show_beyond(mesh, m) || deciding_texture(mesh, m);
}

float rough_within(const Mesh& mesh, std::uint32_t triangle, const TrianglePart& part) {
  const Material& m = mesh.materials[mesh.triangle_materials[triangle]];
  if (!may_show_beyond(mesh, m)) return std::numeric_limits<float>::infinity();
  const Texture* const texture = deciding_texture(mesh, m);
  if (!texture) return 0.0f;
  const MaterialMaps& maps = *maps_of(mesh, m);
  const OnTexture on(mesh, maps.metallic_roughness, texture->size(), triangle, part);
  const double least = 255.0 * 1.00001 * shared::kRoughestMirror / maps.surface.roughness;
  const Greens greens(*texture, maps.metallic_roughness, on, least);
  const double longest = 0.99 * greens.longest_footprint() / on.texels_per_unit;
  return longest > 0.0 ? static_cast<float>(longest) : 0.0f;  // not a number: the triangle is a line
}

}  // namespace pinocchio
