#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pinocchio::gl {

// What a process of its own said before it ended, and how it ended where that was not as it should.
struct Apart {
  std::vector<std::string> said;
  std::string failure;  // empty: it came to its end
};

// Does something that may crash, in a child process: a driver cannot take the program with it. To be called
// before OpenGL is used and threads are started here, as the child has neither. It ends after `seconds` at
// most.
[[nodiscard]] Apart try_apart(
    const std::function<void(const std::function<void(const std::string&)>& say)>& act, int seconds = 30);

}  // namespace pinocchio::gl
