#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "pinocchio/error.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/image.h"
#include "pinocchio/progress.h"

namespace pinocchio {

class Warnings;

// The most bytes of memory that a scene's files may claim beyond their own size: for unpacked pictures,
// compressed meshes and copies of a mesh.
inline constexpr std::uint64_t kUsualLoadLimit = std::uint64_t{4} << 30;

// Light from all directions, seen where no triangle is: a picture in latitude and longitude, linear, as
// OpenEXR defines it. The top row is +Y, the middle of the picture +Z, a quarter of the width to its left is
// +X. Immutable.
class Environment {
 public:
  // Values that are negative or not finite count as zero. The picture has at least one pixel.
  explicit Environment(Image<glm::vec3> radiance, std::string source = {});

  [[nodiscard]] const Image<glm::vec3>& radiance() const { return radiance_; }
  [[nodiscard]] const std::string& source() const { return source_; }  // the file's path
  [[nodiscard]] bool is_black() const { return rows_.back() <= 0.0f; }

  // Tables for choosing directions in proportion to their light. Cumulative light, from 0 to 1: up to the end
  // of each row, and within each row up to the end of each texel. A texel has the interpolated light of its
  // area, weighted by its row's share of the sphere. Guides, for rows and for columns: of n ends, entry k is
  // the index where the search for k / n begins.
  struct Shares {
    const float *rows, *columns;
    const std::uint32_t *row_guides, *column_guides;
  };
  [[nodiscard]] Shares shares() const {
    return {rows_.data(), columns_.data(), row_guides_.data(), column_guides_.data()};
  }
  // A word for each square between the middles of four texels: their luminances as numbers of 8 bits
  // (core/scene/sky/brightness.h), upper left, upper right, lower left, lower right from the lowest bits up.
  // A row more than the picture has: the first square of a column is above its first texel's middle. Squares
  // begin at the middles of their columns.
  [[nodiscard]] const std::uint32_t* brightness() const { return brightness_.data(); }

 private:
  Image<glm::vec3> radiance_;
  std::string source_;
  std::vector<float> rows_;
  std::vector<float, PixelAllocator<float>> columns_;
  std::vector<std::uint32_t> row_guides_;
  std::vector<std::uint32_t, PixelAllocator<std::uint32_t>> column_guides_, brightness_;
};

// Reads an EXR or Radiance (.hdr, RGBE) picture, told by its bytes. An EXR has the channels R, G and B, or Y
// alone or with RY and BY. A cube map (attribute envmap) is converted to latitude and longitude. NaN is read
// as 0 and infinity as the largest finite value, each with a warning. The path "studio" is the studio's sky
// (studio.h), whatever files there are.
// Errors name the file. Phase "read".
[[nodiscard]] Expected<std::shared_ptr<const Environment>> load_environment(
    const std::filesystem::path& path, Progress* progress = nullptr,
    std::uint64_t limit_bytes = kUsualLoadLimit, Warnings* warnings = nullptr);

}  // namespace pinocchio
