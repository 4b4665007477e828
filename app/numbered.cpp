#include "app/numbered.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "core/base/folder.h"
#include "core/image/atomic_file.h"

namespace pinocchio::app {
namespace {

// The number by which `pattern` is called `name`.
std::optional<int> number_in(const std::string& pattern, const std::string& name) {
  const std::size_t first = pattern.find('#'),
                    end = std::min(pattern.find_first_not_of('#', first), pattern.size());
  const std::size_t fixed = first + (pattern.size() - end);
  if (name.size() <= fixed) return std::nullopt;
  const std::optional<int> number = parse_int(name.substr(first, name.size() - fixed));
  return number && *number >= 0 && numbered(pattern, *number) == name ? number : std::nullopt;
}

}  // namespace

std::filesystem::path numbered(const std::string& pattern, int number) {
  const std::size_t first = pattern.find('#');
  if (first == std::string::npos) return pattern;
  const std::size_t end = std::min(pattern.find_first_not_of('#', first), pattern.size());
  std::string digits = std::to_string(number);
  if (digits.size() < end - first) digits.insert(0, end - first - digits.size(), '0');
  return pattern.substr(0, first) + digits + pattern.substr(end);
}

std::vector<int> numbers_in_use(const std::string& pattern, const FrameRange& range,
                                const std::filesystem::path& other) {
  if (pattern.find('#') == std::string::npos) return {range.first};
  std::filesystem::path folder, name;  // down to what holds the number, a file or a folder
  for (const std::filesystem::path& part : std::filesystem::path(pattern)) {
    folder /= name;
    name = part;
    if (part.string().find('#') != std::string::npos) break;
  }
  std::vector<int> numbers;
  const auto look_at = [&](const std::filesystem::path& file) {
    const std::optional<int> number = number_in(name.string(), file.filename().string());
    if (number && range.contains(*number)) numbers.push_back(*number);
  };
  look_at(other);
  // A folder that cannot be read is met again when it is written to.
  for (const std::string& entry : names_in(folder)) {
    const std::filesystem::path file = folder / entry;
    look_at(file);
    std::error_code none;
    if (std::filesystem::is_symlink(file, none)) look_at(written_file(file));  // which may not be there yet
  }
  return numbers;
}

}  // namespace pinocchio::app
