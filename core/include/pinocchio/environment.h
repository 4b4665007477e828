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

// Most bytes of memory that a scene's files may claim beyond their own: pictures unpacked, compressed meshes,
// copies of a mesh.
inline constexpr std::uint64_t kUsualLoadLimit = std::uint64_t{4} << 30;

// What is seen, and shines, where no triangle is: a picture of all directions in latitude and longitude,
// linear light, as OpenEXR has it: the top row is up (+Y), the middle +Z, a quarter of the width left of it
// +X. Immutable.
class Environment {
 public:
  // Values below zero, or not finite, count as zero. At least one pixel.
  explicit Environment(Image<glm::vec3> radiance, std::string source = {});

  [[nodiscard]] const Image<glm::vec3>& radiance() const { return radiance_; }
  [[nodiscard]] const std::string& source() const { return source_; }  // path it was read from
  [[nodiscard]] bool is_black() const { return rows_.back() <= 0.0f; }

  // A place of the picture, u to the right and v down, 0 to 1, that is the more likely the brighter it is
  // there, from two numbers in [0, 1); and how likely: per unit of u times v. Not for black ones.
  struct Place {
    glm::vec2 uv;
    float density;
  };
  [[nodiscard]] Place sample(const glm::vec2& numbers) const;
  [[nodiscard]] float density(const glm::vec2& uv) const;

 private:
  Image<glm::vec3> radiance_;
  std::string source_;
  // Of what interpolation makes of each texel's area, times its row's share of the sphere: the light up to
  // the end of each row, and within each row up to the end of each texel; both grow from 0 to 1.
  std::vector<float> rows_, columns_;
};

// Reads an EXR or a Radiance picture (.hdr, RGBE), by what the file holds. An EXR has channels R, G and B, or
// Y, with RY and BY or alone; where its attribute envmap says cube map, it becomes a picture in latitude and
// longitude. NaN becomes 0, infinity the largest finite value, and `warnings` say so. Errors name the file.
// Phase "read".
[[nodiscard]] Expected<std::shared_ptr<const Environment>> load_environment(
    const std::filesystem::path& path, Progress* progress = nullptr,
    std::uint64_t limit_bytes = kUsualLoadLimit, Warnings* warnings = nullptr);

}  // namespace pinocchio
