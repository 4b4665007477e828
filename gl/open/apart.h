#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pinocchio::gl {

// What a child process reported, and how it failed.
struct Apart {
  std::vector<std::string> reports;
  std::string failure;  // empty: it ended normally
};

using Report = std::function<void(const std::string&)>;

// Runs an action that may crash, for example in a driver, in a child process. The action calls `report` with
// each text. The child is killed after `seconds`. Call it before this process uses OpenGL and starts threads:
// the child inherits neither.
[[nodiscard]] Apart try_apart(const std::function<void(const Report& report)>& act, int seconds = 30);

}  // namespace pinocchio::gl
