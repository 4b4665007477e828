#include "app/cli/numbered.h"

#include <algorithm>
#include <optional>

#include "core/files/atomic_file.h"
#include "core/files/folder.h"

namespace pinocchio::app {
namespace {

std::string with_number(const std::string& pattern, const NumberPlace& place, int number) {
  std::string digits = std::to_string(number);
  const std::size_t width = place.end - place.first;
  if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
  return pattern.substr(0, place.first) + digits + pattern.substr(place.end);
}

// The number with which `pattern` gives `name`.
std::optional<int> number_in(const std::string& pattern, const NumberPlace& place, const std::string& name) {
  const std::size_t fixed = place.first + (pattern.size() - place.end);
  if (name.size() <= fixed) return std::nullopt;
  const std::optional<int> number = parse_int(name.substr(place.first, name.size() - fixed));
  return number && *number >= 0 && with_number(pattern, place, *number) == name ? number : std::nullopt;
}

}  // namespace

NumberPlace number_place(const std::string& pattern) {
  const std::size_t name = pattern.rfind('/') + 1;  // 0 where there is no folder
  std::size_t end = pattern.size();
  while (end > 0) {
    std::size_t first = end;
    while (first > 0 && pattern[first - 1] == '#') --first;
    if (end - first > 1 || (first < end && first >= name)) return {first, end};
    end = first < end ? first : end - 1;
  }
  return {};
}

std::filesystem::path numbered(const std::string& pattern, int number) {
  const NumberPlace place = number_place(pattern);
  return place.empty() ? pattern : with_number(pattern, place, number);
}

std::vector<int> numbers_in_use(const std::string& pattern, const FrameRange& range,
                                const std::vector<std::filesystem::path>& others) {
  const NumberPlace place = number_place(pattern);
  if (place.empty()) return {range.first};
  // The part of the path with the number, and the folder that it is in.
  const std::filesystem::path until =
      pattern.substr(0, std::min(pattern.find('/', place.end), pattern.size()));
  const std::filesystem::path folder = until.parent_path();
  const std::string name = until.filename().string();
  const std::size_t begin = until.string().size() - name.size();
  const NumberPlace in_name{place.first - begin, place.end - begin};
  std::vector<int> numbers;
  const auto add_number_of = [&](const std::filesystem::path& file) {
    const std::optional<int> number = number_in(name, in_name, file.filename().string());
    if (number && range.contains(*number)) numbers.push_back(*number);
  };
  for (const std::filesystem::path& other : others) add_number_of(other);
  // A folder that cannot be read is an error when a file is written there.
  for (const std::string& entry : names_in(folder)) {
    const std::filesystem::path file = folder / entry;
    add_number_of(file);
    std::error_code none;
    if (std::filesystem::is_symlink(file, none)) add_number_of(written_file(file));  // need not exist
  }
  return numbers;
}

}  // namespace pinocchio::app
