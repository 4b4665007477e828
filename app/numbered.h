// A range's files: one name, with # where the frame's number goes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/parse.h"

namespace pinocchio::app {

// `pattern` with its run of # replaced by the number, filled up with zeros.
[[nodiscard]] std::filesystem::path numbered(const std::string& pattern, int number);

// Frames of the range whose file is there, as far as its folder says, or is named like `other`: those of a
// range of any length that can be a file that something else is, too. Of a pattern without #: the first.
[[nodiscard]] std::vector<int> numbers_in_use(const std::string& pattern, const FrameRange& range,
                                              const std::filesystem::path& other);

}  // namespace pinocchio::app
