// Pictures of a window, and what tests ask of them.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "pinocchio/image.h"

namespace pinocchio {

using Picture = Image<glm::u8vec3>;

// A PNG file; no pixels where it cannot be read.
[[nodiscard]] Picture picture_of_file(const std::filesystem::path& file);

// The part in a box "WIDTHxHEIGHT+X+Y", as far as it lies in the picture.
[[nodiscard]] Picture crop(const Picture& picture, const std::string& box);

// Pixels of which a channel differs by more than `percent` of its range; -1: one is empty, or they differ in
// size.
[[nodiscard]] long long different_pixels(const Picture& a, const Picture& b, int percent = 0);

// Red, green and blue, 0 to 1.
[[nodiscard]] std::array<double, 3> mean_of(const Picture& picture);
[[nodiscard]] std::size_t count_colors(const Picture& picture);

// How bright it is, 0 to 255 (luma of Rec. 709): the greatest of each row.
[[nodiscard]] std::vector<int> brightest_of_rows(const Picture& picture);

}  // namespace pinocchio
