#include "core/files/folder.h"

#include <dirent.h>

#include <memory>

namespace pinocchio {

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  struct Close {
    void operator()(DIR* open) const { closedir(open); }
  };
  const std::unique_ptr<DIR, Close> open(opendir(folder.empty() ? "." : folder.c_str()));
  while (const dirent* const entry = open ? readdir(open.get()) : nullptr) names.emplace_back(entry->d_name);
  std::erase_if(names, [](const std::string& name) { return name == "." || name == ".."; });
  return names;
}

}  // namespace pinocchio
