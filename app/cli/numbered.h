// The files of a range of frames: one name, with # in place of the frame's number.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/parse.h"

namespace pinocchio::app {

// The place of the frame's number in a pattern such as "frame-####.exr": the last run of # in the file's
// name, else the last run of two or more # in a folder's name. A single # there is part of the name, as in
// C#.
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
