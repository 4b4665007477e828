#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace pinocchio {

class Progress;

// Calls write(temporary) with a new name in the file's folder, then gives what was written the file's
// name: whoever reads it finds the old file or the whole new one. A link is written through; a read-only file
// is refused. Throws EnvironmentError, with nothing left behind and the old file untouched, where either
// fails; what `write` throws passes through.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

// The same for text. Phase "write". before_naming is called once all is written and before the file gets its
// name: for files that belong together.
void write_text(const std::filesystem::path& file, const std::string& text, Progress* progress = nullptr,
                const std::function<void()>& before_naming = {});

// Where what is written under this name ends up: a link stays a link, also to a file that is not there yet.
[[nodiscard]] std::filesystem::path written_file(const std::filesystem::path& file);

// Throws EnvironmentError, one line, where write_atomically(file, ...) would fail from the start: before
// work is done that could not be kept. Sweeps the folder of what dead processes left half written.
void check_writable(const std::filesystem::path& file);

}  // namespace pinocchio
