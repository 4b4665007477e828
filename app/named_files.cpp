#include "app/named_files.h"

#include <sys/stat.h>

#include <map>

#include "app/errors.h"
#include "core/image/atomic_file.h"

namespace pinocchio::app {
namespace {

// What every name of one file has in common. Of a file that is there: the file system's own number, which
// hard links share; else its place.
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
  std::map<std::string, const NamedFile*> taken;
  for (const NamedFile& input : inputs)
    if (!input.file.empty()) taken.emplace(identity(input.file), &input);
  for (const NamedFile& output : outputs) {
    if (output.file.empty()) continue;
    const auto [other, is_free] = taken.emplace(identity(output.file), &output);
    const bool is_same_name =
        !is_free && other->second->role == output.role && other->second->file == output.file;
    if (!is_free && !is_same_name)  // frames under one name: whoever numbers them says so
      throw Exit(kUsage, output.role + " " + output.file.string() + ": the same file as " +
                             other->second->role + " " + other->second->file.string() +
                             "; choose another name");
  }
}

}  // namespace pinocchio::app
