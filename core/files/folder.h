#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pinocchio {

// The names of a folder's entries, in any order; none if the folder cannot be read. (std::filesystem's
// iterators end the program if there is no memory.)
[[nodiscard]] std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace pinocchio
