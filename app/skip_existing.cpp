#include "app/skip_existing.h"

#include <algorithm>
#include <filesystem>

namespace pinocchio::app {
namespace {

namespace fs = std::filesystem;

// A file that is missing is older than all.
fs::file_time_type written_at(const fs::path& file) {
  std::error_code missing;
  const fs::file_time_type time = fs::last_write_time(file, missing);
  return missing ? fs::file_time_type::min() : time;
}

bool is_newer(const fs::path& file, const Scene& scene) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) == 0) return false;
  return std::ranges::none_of(scene.source_files, [time = written_at(file)](const std::string& source) {
    return written_at(source) > time;
  });
}

bool is_ours(const std::string& attribute) {
  return attribute.starts_with("pinocchio.");
}

bool same_header(const ExrFile& file, const ExrFile& wanted) {
  const PixelBox &a = file.data_window, &b = wanted.data_window;
  if (file.display_size != wanted.display_size || a.lo != b.lo || a.hi != b.hi ||
      file.compression != wanted.compression || file.channels.size() != wanted.channels.size())
    return false;
  for (const ExrChannel& channel : wanted.channels) {
    const ExrChannel* const found = file.find(channel.name);
    if (!found || found->type != channel.type) return false;
  }
  for (const auto& [name, value] : wanted.attributes) {
    const auto found = file.attributes.find(name);
    if (found == file.attributes.end() || found->second != value) return false;
  }
  return std::ranges::all_of(file.attributes, [&](const auto& attribute) {
    return !is_ours(attribute.first) || wanted.attributes.contains(attribute.first);
  });
}

}  // namespace

bool is_drawn_already(const OutputOptions& options, const FrameRequest& request, const FrameHeader& frame) {
  const fs::path exr = numbered(options.exr, frame.number), png = numbered(options.preview, frame.number);
  if (!options.preview.empty() && !is_newer(png, request.scene)) return false;
  if (!is_newer(exr, request.scene)) return false;
  const Expected<ExrFile> file = read_exr(exr);
  if (!file) return false;
  FrameResult picture;
  picture.scene = request.scene;
  picture.view = request.view;
  picture.settings = request.settings;
  return same_header(*file, exr_header(picture, exr_options(options, frame)));
}

}  // namespace pinocchio::app
