// Input files, which may be damaged or hostile.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "core/files/file_bytes.h"
#include "pinocchio/error.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// The error and the remedy for a file that does not exist: the name may be a network address.
[[nodiscard]] std::pair<std::string, std::string> absence_of(const std::filesystem::path& file);

// Reads all of a file's bytes. A FIFO, a device or a folder is an error: reading it might never end. Phase
// "read".
[[nodiscard]] Expected<FileBytes> read_input_file(const std::filesystem::path& file, Progress* progress);

// The same for an open file, which this function closes. -1: opening it failed. `file` is for errors.
[[nodiscard]] Expected<FileBytes> read_open_file(int descriptor, const std::filesystem::path& file,
                                                 Progress* progress);

// Converts text to UTF-8 without a byte order mark. The mark tells whether the text is UTF-16.
[[nodiscard]] FileBytes as_utf8(FileBytes text);

}  // namespace pinocchio
