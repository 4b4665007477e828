#include "app/cli/named_files.h"

#include <sys/stat.h>

#include <map>

#include "app/cli/errors.h"
#include "core/files/atomic_file.h"

namespace pinocchio::app {
namespace {

// The same for all names of one file: the file system's number of an existing file, which hard links share,
// else its place.
std::string identity(const std::filesystem::path& file) {
  struct stat found {};
  if (stat(file.c_str(), &found) == 0)
    return std::to_string(found.st_dev) + ":" + std::to_string(found.st_ino);
  std::error_code error;
  const std::filesystem::path place =
      std::filesystem::weakly_canonical(std::filesystem::absolute(written_file(file)), error);
  return error ? file.lexically_normal().string() : place.string();
}

}  // namespace

void check_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  std::map<std::string, const NamedFile*> named;
  for (const NamedFile& input : inputs)
    if (!input.file.empty()) named.emplace(identity(input.file), &input);
  for (const NamedFile& output : outputs) {
    if (output.file.empty()) continue;
    const auto [other, is_free] = named.emplace(identity(output.file), &output);
    const bool is_same_name =
        !is_free && other->second->role == output.role && other->second->file == output.file;
    if (!is_free && !is_same_name)  // check_outputs reports frames of one name
      throw Exit(kUsage, output.role + " " + output.file.string() + ": the same file as " +
                             other->second->role + " " + other->second->file.string() +
                             "; choose another name");
  }
}

}  // namespace pinocchio::app
