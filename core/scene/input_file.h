// Files as somebody else made them.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "core/scene/file_bytes.h"
#include "pinocchio/error.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// What is wrong, and what to do, where there is no such file: it may be on the network.
[[nodiscard]] std::pair<std::string, std::string> absence_of(const std::filesystem::path& file);

// All of a file's bytes. A FIFO, a device or a folder is an error at once: reading it might never end. Phase
// "read".
[[nodiscard]] Expected<FileBytes> read_input_file(const std::filesystem::path& file, Progress* progress);

// The same of a file that is open, which is closed; -1: opening it failed. `file` is for errors.
[[nodiscard]] Expected<FileBytes> read_open_file(int descriptor, const std::filesystem::path& file,
                                                 Progress* progress);

// The text as UTF-8 without a byte order mark, which says whether it was UTF-16.
[[nodiscard]] FileBytes as_utf8(FileBytes text);

}  // namespace pinocchio
