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

// The text as UTF-8 without a byte order mark, which says whether it was UTF-16.
[[nodiscard]] FileBytes as_utf8(FileBytes text);

// A file that another one names, beside it: `name` as it is, or its last part, where it is a path of the
// machine that wrote it. Backslashes divide as slashes do. The first of them where neither is there.
[[nodiscard]] std::filesystem::path named_file(const std::filesystem::path& by, std::string name);

}  // namespace pinocchio
