#include "app/run/skip_existing.h"

#include <algorithm>

#include "core/image/codecs/png.h"

namespace pinocchio::app {
namespace {

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
  FrameResult picture;
  picture.scene = request.scene;
  picture.view = request.view;
  picture.settings = request.settings;
  const ExrFile wanted = exr_header(picture, exr_options(options, frame));
  if (!options.preview.empty() &&
      text_of_png(numbered(options.preview, frame.number)) != preview_text(options, wanted))
    return false;
  const Expected<ExrFile> file = read_exr(numbered(options.exr, frame.number));
  return file && same_header(*file, wanted);
}

}  // namespace pinocchio::app
