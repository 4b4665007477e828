#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace pinocchio {

class Progress;

// Calls write(temporary) with a new name in the file's folder, then renames the result to the file's name:
// readers find the old file or the whole new one. A link's target is written. A read-only file is an error.
// Throws EnvironmentError if either step fails; the new file is then removed and the old one is unchanged.
// Exceptions of `write` pass through.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

// The same for text. Phase "write". before_naming is called after the text is written and before the file is
// renamed: for files that belong together.
void write_text(const std::filesystem::path& file, const std::string& text, Progress* progress = nullptr,
                const std::function<void()>& before_naming = {});

// The path that is written for this name: a link's target, also if that file does not exist yet.
[[nodiscard]] std::filesystem::path written_file(const std::filesystem::path& file);

// Throws EnvironmentError if write_atomically(file, ...) is sure to fail, so that no work is done whose
// result could not be kept. Removes half-written files of ended processes from the folder.
void check_writable(const std::filesystem::path& file);

}  // namespace pinocchio
