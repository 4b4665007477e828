// The files of a range of frames: one name, with # in place of the frame's number.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/parse.h"

namespace pinocchio::app {

// `pattern` with its run of # replaced by the number, padded with zeros.
[[nodiscard]] std::filesystem::path numbered(const std::string& pattern, int number);

// The frames of the range whose file exists or may be named like one of `others`, however long the range is.
// For a pattern without #: the first frame.
[[nodiscard]] std::vector<int> numbers_in_use(const std::string& pattern, const FrameRange& range,
                                              const std::vector<std::filesystem::path>& others);

}  // namespace pinocchio::app
