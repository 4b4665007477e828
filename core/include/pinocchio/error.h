// Errors of input: what a person gave us and can mend. They travel as values (Expected), never as
// exceptions; a failed environment (no context, disk full) is an EnvironmentError, caught once in main.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tl/expected.hpp>

namespace pinocchio {

// One clear line: file, line where known, what is wrong, what to do.
struct InputError {
  std::string file;  // empty: not about a file
  int line = 0;      // 1-based; 0: not known
  std::string what;
  std::string remedy;  // empty: nothing helpful to say

  [[nodiscard]] std::string message() const {
    std::string text = file;
    if (line > 0) text.append(":").append(std::to_string(line));
    if (!text.empty()) text += ": ";
    text += what;
    if (!remedy.empty()) text += "; " + remedy;
    // What a damaged file holds is quoted: it stays one line and commands no terminal.
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
    return text;
  }
};

template <class T>
using Expected = tl::expected<T, InputError>;
using Unexpected = tl::unexpected<InputError>;

// Thrown where the machine, not the input, is at fault; what() is the line a person reads.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pinocchio
