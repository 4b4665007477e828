// Lines and words of OBJ and MTL text.
#pragma once

#include <algorithm>
#include <string_view>

namespace pinocchio {

// Line by line: they end with CR LF, LF or CR alone.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
    ++number_;
    return true;
  }

  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] int number() const { return number_; }  // from 1

 private:
  std::string_view rest_, line_;
  int number_ = 0;
};

// Cuts the next word off the line; empty at its end.
inline std::string_view next_word(std::string_view& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) {
    line = {};
    return {};
  }
  const std::size_t end = std::min(line.find_first_of(" \t\r", first), line.size());
  const std::string_view word = line.substr(first, end - first);
  line.remove_prefix(end);
  return word;
}

}  // namespace pinocchio
