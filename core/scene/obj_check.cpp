#include "core/scene/obj_check.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

namespace pinocchio {
namespace {

// Cuts the next word off the line; empty at its end.
std::string_view next_word(std::string_view& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  const std::size_t end = std::min(line.find_first_of(" \t\r", first), line.size());
  const std::string_view word = line.substr(first, end - first);
  line.remove_prefix(end);
  return word;
}

template <class T>
std::optional<T> number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  T value{};
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure == std::errc::result_out_of_range && std::is_floating_point_v<T>)
    return static_cast<T>(std::strtod(std::string(word).c_str(), nullptr));  // 1e-400: 0, 1e400: infinity
  if (failure != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// What the numbers of a face's corner (v/vt/vn) count.
enum Kind { kVertex, kTexcoord, kNormal, kKinds };
constexpr std::array<const char*, kKinds> kKindNames{"vertex", "texture coordinate", "normal"};

constexpr int kLinesBetweenLooks = 4096;

class Checker {
 public:
  Checker(std::string& text, const std::filesystem::path& file) : text_(text), file_(file) {}

  Expected<void> check(const Progress* progress) {
    std::string_view text = text_;
    while (!text.empty()) {
      if (++line_ % kLinesBetweenLooks == 0) throw_if_cancelled(progress);
      // As the parser has it: CR LF, LF or CR alone.
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
      const Expected<void> checked = check_line(text.substr(0, end));
      if (!checked) return checked;
      text.remove_prefix(end);
      text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
    }
    // Forward references are allowed, so only the end tells.
    for (int kind = 0; kind < kKinds; ++kind)
      if (highest_[kind].index > counts_[kind])
        return fail(highest_[kind].line, std::string("a face names ") + kKindNames[kind] + " " +
                                             std::to_string(highest_[kind].index) + ", there are " +
                                             std::to_string(counts_[kind]));
    return {};
  }

 private:
  struct Reference {
    long long index = 0;
    int line = 0;
  };

  Unexpected fail(int line, const std::string& what) const {
    return Unexpected(InputError{file_.string(), line, what, "export the file again"});
  }

  Expected<void> check_line(std::string_view line) {
    const std::string_view word = next_word(line);
    if (word == "v") return check_numbers(line, 3, 3, kVertex);
    if (word == "vn") return check_numbers(line, 3, 3, kNormal);
    if (word == "vt") return check_numbers(line, 1, 2, kTexcoord);
    if (word == "f") return check_face(line);
    return {};
  }

  Expected<void> check_numbers(std::string_view line, int least, int most, Kind kind) {
    for (int i = 0; i < most; ++i) {
      const std::string_view word = next_word(line);
      if (i >= least && (word.empty() || word.front() == '#')) break;
      const std::optional<double> value = number<double>(word);
      if (!value || !std::isfinite(static_cast<float>(*value)))
        return fail(line_,
                    "'" + std::string(word) + "' in a " + kKindNames[kind] + " is not a finite number");
    }
    ++counts_[kind];
    return {};
  }

  Expected<void> check_face(std::string_view line) {
    int corners = 0;
    for (std::string_view corner; !(corner = next_word(line)).empty() && corner.front() != '#'; ++corners) {
      const std::string_view whole = corner;
      blank_last_slashes(corner);
      for (int kind = 0; kind < kKinds; ++kind) {
        const std::size_t end = std::min(corner.find('/'), corner.size());
        const std::string_view word = corner.substr(0, end);
        corner.remove_prefix(std::min(end + 1, corner.size()));
        if (word.empty() && kind != kVertex) continue;
        const std::optional<long long> index = number<long long>(word);
        if (!index || *index == 0 || *index < -counts_[kind])
          return fail(line_, "a face names " + std::string(kKindNames[kind]) + " '" + std::string(word) +
                                 "', there are " + std::to_string(counts_[kind]) + " so far");
        if (*index > highest_[kind].index) highest_[kind] = {*index, line_};
      }
      if (!corner.empty())
        return fail(line_, "a face has the corner '" + std::string(whole) + "', it ends after the normal");
    }
    if (corners < 3)
      return fail(line_, "a face has " + std::to_string(corners) + " corners, it needs 3 or more");
    return {};
  }

  void blank_last_slashes(std::string_view& corner) {
    while (corner.ends_with('/')) {
      corner.remove_suffix(1);
      text_[static_cast<std::size_t>(corner.data() - text_.data()) + corner.size()] = ' ';
    }
  }

  std::string& text_;
  const std::filesystem::path& file_;
  int line_ = 0;
  std::array<long long, kKinds> counts_{};
  std::array<Reference, kKinds> highest_{};
};

}  // namespace

Expected<void> check_obj_text(std::string& text, const std::filesystem::path& file, const Progress* progress) {
  return Checker(text, file).check(progress);
}

}  // namespace pinocchio
