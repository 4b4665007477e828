#include "app/compare_pairs.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "app/errors.h"
#include "core/image/tonemap.h"
#include "core/scene/texture_file.h"

namespace pinocchio::app {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, fs::path>;  // by what the two sides have in common

bool is_picture(const fs::path& file) {
  return file.extension() == ".exr" || file.extension() == ".png";
}

bool is_sequence(const std::string& name) {
  return fs::path(name).filename().string().find('#') != std::string::npos;
}

// Not what is being written, whose name begins with a dot.
Files pictures_in(const fs::path& folder) {
  Files files;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (is_picture(entry->path()) && entry->path().filename().string().front() != '.' &&
        entry->is_regular_file(error))
      files.emplace(entry->path().lexically_relative(folder).generic_string(), entry->path());
  return files;
}

// By number. A number may have more digits than the pattern has #, as in render's -o.
Files frames_of(const std::string& pattern) {
  const fs::path path(pattern), folder = path.has_parent_path() ? path.parent_path() : ".";
  const std::string name = path.filename().string();
  const std::size_t first = name.find('#'), end = std::min(name.find_first_not_of('#', first), name.size());
  const std::string before = name.substr(0, first), after = name.substr(end);
  Files files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), last; !error && entry != last; entry.increment(error)) {
    const std::string found = entry->path().filename().string();
    if (found.size() < before.size() + after.size() + (end - first)) continue;
    if (!found.starts_with(before) || !found.ends_with(after)) continue;
    const std::string digits = found.substr(before.size(), found.size() - before.size() - after.size());
    if (std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; }))
      files.emplace(digits, entry->path());
  }
  return files;
}

std::vector<PicturePair> pairs_of(const Files& a, const Files& b) {
  std::map<std::string, PicturePair> pairs;
  for (const auto& [name, file] : a) pairs[name] = {name, file, {}};
  for (const auto& [name, file] : b) {
    pairs[name].name = name;
    pairs[name].b = file;
  }
  std::vector<PicturePair> list;
  for (auto& [name, pair] : pairs) list.push_back(std::move(pair));
  return list;
}

}  // namespace

std::vector<PicturePair> find_pairs(const std::string& a, const std::string& b) {
  const auto nothing = [](const std::string& where) {
    return Exit(kBadScene, where + ": there is no EXR or PNG; check its name");
  };
  if (is_sequence(a) != is_sequence(b))
    throw Exit(kUsage, "of " + a + " and " + b + " one is a sequence; give #### in both names or in none");
  if (is_sequence(a)) {
    const Files of_a = frames_of(a), of_b = frames_of(b);
    if (of_b.empty()) throw nothing(b);
    if (of_a.empty()) throw nothing(a);
    return pairs_of(of_a, of_b);
  }
  const bool folder = fs::is_directory(a);
  if (folder != fs::is_directory(b))
    throw Exit(kUsage, "of " + a + " and " + b + " one is a folder; give two folders or two pictures");
  if (!folder) return {{fs::path(a).filename().string(), a, b}};
  const Files of_a = pictures_in(a), of_b = pictures_in(b);
  if (of_b.empty()) throw nothing(b);
  if (of_a.empty()) throw nothing(a);
  return pairs_of(of_a, of_b);
}

Expected<NamedExr> read_picture(const fs::path& file) {
  const std::string name = file.string();
  if (file.extension() != ".png") {
    Expected<ExrFile> exr = read_exr(file);
    if (!exr) return Unexpected(exr.error());
    return NamedExr{name, std::move(*exr)};
  }
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    return Unexpected(InputError{name, 0, "there is no such file", "check its name"});
  Warnings warnings;
  MemoryLimit limit(kUsualLoadLimit);
  InputFiles files(file, false);
  Loading loading{warnings, nullptr, limit, files};
  const Expected<DecodedImage> decoded = load_texture(file, loading);
  if (!decoded) return Unexpected(decoded.error());
  if (!decoded->damage.empty())
    return Unexpected(InputError{name, 0, "is damaged: " + decoded->damage, "write it again"});
  const Image<glm::u8vec4>& png = decoded->texture.texels;
  NamedExr picture{name, {}};
  picture.exr.display_size = png.size();
  picture.exr.data_window = {{0, 0}, png.size()};
  constexpr std::array kChannels{"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    ExrChannel& channel = picture.exr.channels.emplace_back();
    channel.name = kChannels[static_cast<std::size_t>(c)];
    channel.type = ExrChannel::Type::real;
    for (const glm::u8vec4& texel : png.pixels()) channel.values.push_back(srgb8_to_linear(texel[c]));
  }
  return picture;
}

}  // namespace pinocchio::app
