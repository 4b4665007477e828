#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace pinocchio {

class Progress;

// Calls write(temporary) with a new name in the file's folder, then gives what was written the file's
// name: whoever reads it finds the old file or the whole new one. Throws EnvironmentError, with nothing
// left behind and the old file untouched, where either fails; what `write` throws passes through.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

// The same for text. Phase "write".
void write_text(const std::filesystem::path& file, const std::string& text, Progress* progress = nullptr);

// Throws EnvironmentError, one line, where write_atomically(file, ...) would fail from the start: before
// work is done that could not be kept.
void check_writable(const std::filesystem::path& file);

}  // namespace pinocchio
