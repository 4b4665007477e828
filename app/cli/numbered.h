// The files of a range of frames: one name, with # in place of the frame's number.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/parse.h"

namespace pinocchio::app {

// Where a pattern such as "frame-####.exr" has its number: at the last #s of the file's name. If that has
// none, at the last two or more #s of the folders; a single one there belongs to a name (C#). Empty: nowhere.
struct NumberPlace {
  std::size_t first = 0, end = 0;

  [[nodiscard]] bool empty() const { return first == end; }
};
[[nodiscard]] NumberPlace number_place(const std::string& pattern);

// `pattern` with the number in its place, padded with zeros.
[[nodiscard]] std::filesystem::path numbered(const std::string& pattern, int number);

// The frames of the range whose file exists or may be named like one of `others`, however long the range is.
// For a pattern without #: the first frame.
[[nodiscard]] std::vector<int> numbers_in_use(const std::string& pattern, const FrameRange& range,
                                              const std::vector<std::filesystem::path>& others);

}  // namespace pinocchio::app
