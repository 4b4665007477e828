// The pairs of pictures that `compare` compares.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pinocchio::app {

struct PicturePair {
  std::string name;            // of both: a file's name, a frame's digits
  std::filesystem::path a, b;  // b is the reference; one of them may be missing
};

// a, b: two pictures, two folders (whose .exr and .png of the same name are compared), or two sequences,
// whose names have a run of # in place of the frame's number. Ordered by name. Ends the verb with kUsage
// where a and b are of different kinds, with kBadScene where there is nothing to compare.
[[nodiscard]] std::vector<PicturePair> find_pairs(const std::string& a, const std::string& b);

}  // namespace pinocchio::app
