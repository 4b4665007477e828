// The lines and words of OBJ, MTL and STL text.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

namespace pinocchio {

inline constexpr char kJoint = '\v';  // marks where a backslash joined two lines

// Joins lines that end with a backslash to the next line, except comments: one may end with a Windows path.
// The text's length stays.
inline void join_lines(std::span<char> text) {
  const std::string_view read(text.data(), text.size());
  std::size_t line = 0, seen = 0;  // where the line begins, looked for up to `seen`
  for (std::size_t at = read.find('\\'); at != read.npos; at = read.find('\\', at + 1)) {
    const std::size_t end = at + 1 + (read.substr(at + 1).starts_with("\r\n") ? 1 : 0);
    if (end >= text.size() || (text[end] != '\n' && text[end] != '\r')) continue;
    for (; seen < at; ++seen)
      if (read[seen] == '\n' || read[seen] == '\r') line = seen + 1;
    if (read[std::min(read.find_first_not_of(" \t", line), at)] == '#') continue;
    text[at] = text[at + 1] = ' ';
    text[end] = kJoint;
  }
}

// Reads lines that end with CR LF, LF or CR.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  bool next() {
    if (rest_.empty()) return false;
    number_ += 1 + std::count(line_.begin(), line_.end(), kJoint);
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
    return true;
  }

  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] int number() const { return number_; }  // from 1; of joined lines, the first one's

 private:
  std::string_view rest_, line_;
  int number_ = 0;
};

inline constexpr std::string_view kBlanks = " \t\r\v\f";

// Removes the next word from the line; empty at the end.
inline std::string_view next_word(std::string_view& line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    line = {};
    return {};
  }
  const std::size_t end = std::min(line.find_first_of(kBlanks, first), line.size());
  const std::string_view word = line.substr(first, end - first);
  line.remove_prefix(end);
  return word;
}

// The rest of a line without blanks around it. A name may have blanks inside.
inline std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  return first == std::string_view::npos ? std::string_view()
                                         : line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
}

// A name without the comment behind it. Names may hold a #, too: try the whole first.
inline std::string_view without_comment(std::string_view name) {
  const std::size_t comment = name.find(" #");
  return comment == std::string_view::npos ? name : trimmed(name.substr(0, comment));
}

}  // namespace pinocchio
