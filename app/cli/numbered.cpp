#include "app/cli/numbered.h"

#include <algorithm>
#include <optional>

#include "core/files/atomic_file.h"
#include "core/files/folder.h"

namespace pinocchio::app {
namespace {

// The number for which `pattern` gives `name`.
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
                                const std::vector<std::filesystem::path>& others) {
  if (pattern.find('#') == std::string::npos) return {range.first};
  std::filesystem::path folder, name;  // `name` is the part with the number
  for (const std::filesystem::path& part : std::filesystem::path(pattern)) {
    folder /= name;
    name = part;
    if (part.string().find('#') != std::string::npos) break;
  }
  std::vector<int> numbers;
  const auto add_number_of = [&](const std::filesystem::path& file) {
    const std::optional<int> number = number_in(name.string(), file.filename().string());
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
