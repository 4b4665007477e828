#include "app/report/compare_pairs.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "app/cli/errors.h"
#include "app/cli/numbered.h"
#include "core/image/codecs/formats.h"

namespace pinocchio::app {
namespace {

namespace fs = std::filesystem;

struct Found {
  std::string name;  // PicturePair's
  fs::path file;
};
using Files = std::map<std::string, Found>;  // by what pairs them, in the order of the pairs

bool is_picture(const fs::path& file) {
  const PictureFormat* const format = format_of(file);
  return format && format->written;
}

// A folder that is read in part would compare less than was asked for.
void throw_if_unread(const fs::path& folder, const std::error_code& error) {
  if (error && error != std::errc::no_such_file_or_directory)
    throw Exit(kBadScene, folder.string() + " cannot be read whole: " + error.message() +
                              "; make it readable, or leave it out");
}

bool is_sequence(const std::string& name) {
  return !number_place(fs::path(name).filename().string()).empty();
}

// Without files that are being written, whose names begin with a dot.
Files pictures_in(const fs::path& folder) {
  Files files;
  const auto add = [&](const std::string& name, const fs::path& file) {
    files.emplace(name, Found{name, file});
  };
  std::error_code error, unknown;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (is_picture(entry->path()) && entry->path().filename().string().front() != '.' &&
        entry->is_regular_file(unknown))
      add(entry->path().lexically_relative(folder).generic_string(), entry->path());
  throw_if_unread(folder, error);
  return files;
}

// By number, with zeros before it. It may have more digits than the pattern has #, as in render's -o.
Files frames_of(const std::string& pattern) {
  constexpr std::size_t kMostDigits = 20;
  const fs::path path(pattern), folder = path.has_parent_path() ? path.parent_path() : ".";
  const std::string name = path.filename().string();
  const auto [first, end] = number_place(name);
  const std::string before = name.substr(0, first), after = name.substr(end);
  Files files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), last; !error && entry != last; entry.increment(error)) {
    const std::string found = entry->path().filename().string();
    if (found.size() < before.size() + after.size() + (end - first)) continue;
    if (!found.starts_with(before) || !found.ends_with(after)) continue;
    const std::string digits = found.substr(before.size(), found.size() - before.size() - after.size());
    if (!std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; })) continue;
    const std::string key = std::string(kMostDigits - std::min(digits.size(), kMostDigits), '0') + digits;
    files.emplace(key, Found{digits, entry->path()});
  }
  throw_if_unread(folder, error);
  return files;
}

std::vector<PicturePair> pairs_of(const Files& a, const Files& b) {
  std::map<std::string, PicturePair> pairs;
  for (const auto& [key, found] : a) pairs[key] = {found.name, found.file, {}};
  for (const auto& [key, found] : b) {
    PicturePair& pair = pairs[key];
    if (pair.name.empty()) pair.name = found.name;
    pair.b = found.file;
  }
  std::vector<PicturePair> list;
  for (auto& [key, pair] : pairs) list.push_back(std::move(pair));
  return list;
}

}  // namespace

std::vector<PicturePair> find_pairs(const std::string& a, const std::string& b) {
  const auto nothing = [](const std::string& where) {
    return Exit(kBadScene, where + ": there is no EXR or PNG; check its name");
  };
  if (is_sequence(a) != is_sequence(b))
    throw Exit(kUsage, a + " and " + b + " are of different kinds; give #### in both names or in none");
  if (is_sequence(a)) {
    const Files of_a = frames_of(a), of_b = frames_of(b);
    if (of_b.empty()) throw nothing(b);
    if (of_a.empty()) throw nothing(a);
    return pairs_of(of_a, of_b);
  }
  const bool folder = fs::is_directory(a);
  if (folder != fs::is_directory(b))
    throw Exit(kUsage, a + " and " + b + " are of different kinds; give two folders or two pictures");
  if (!folder) return {{fs::path(a).filename().string(), a, b}};
  const Files of_a = pictures_in(a), of_b = pictures_in(b);
  if (of_b.empty()) throw nothing(b);
  if (of_a.empty()) throw nothing(a);
  return pairs_of(of_a, of_b);
}

}  // namespace pinocchio::app
