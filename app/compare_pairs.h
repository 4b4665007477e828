// The pictures that compare is to hold against each other.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/compare/comparison.h"

namespace pinocchio::app {

struct PicturePair {
  std::string name;            // what both have in common: a file's name, a number's digits
  std::filesystem::path a, b;  // b is the reference; one of them may be missing
};

// a, b: two pictures, two folders (and those in them: .exr and .png of the same name), or two sequences, in
// whose names a run of # stands for a frame's number. In order of names. Ends the verb with kUsage where one
// is of another kind than the other, with kBadScene where there is nothing to compare.
[[nodiscard]] std::vector<PicturePair> find_pairs(const std::string& a, const std::string& b);

// An EXR, or a PNG as if it were one: R, G and B, linear. An error where it cannot be read.
[[nodiscard]] Expected<NamedExr> read_picture(const std::filesystem::path& file);

}  // namespace pinocchio::app
