#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pinocchio {

// Names of what a folder holds, in any order; none where it cannot be read. (std::filesystem's iterators end
// the program where there is no memory.)
[[nodiscard]] std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace pinocchio
