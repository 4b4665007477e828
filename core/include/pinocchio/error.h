// Errors in the input, which the user can correct, are returned as values (Expected), never thrown. A failed
// environment (no context, disk full) is thrown as an EnvironmentError and caught once, in main.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tl/expected.hpp>

namespace pinocchio {

// One line: the file, the line if known, what is wrong, what to do.
struct InputError {
  std::string file;  // empty: no file is concerned
  int line = 0;      // 1-based; 0: unknown
  std::string what;
  std::string remedy;  // empty: none is known

  [[nodiscard]] std::string message() const {
    std::string text = file;
    if (line > 0) text.append(":").append(std::to_string(line));
    if (!text.empty()) text += ": ";
    text += what;
    if (!remedy.empty()) text += "; " + remedy;
    // The contents of a damaged file are quoted, so that they are one line without terminal commands.
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
    return text;
  }
};

template <class T>
using Expected = tl::expected<T, InputError>;
using Unexpected = tl::unexpected<InputError>;

// Thrown where the machine, not the input, is at fault. what() is one line for the user.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pinocchio
