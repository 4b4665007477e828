#include "core/files/atomic_file.h"
#include "core/image/codecs/png.h"
#include "core/image/tonemap.h"
#include "hybrid/frame/samples.h"
#include "pinocchio/frame.h"

namespace pinocchio {

std::string encode_png(const FrameResult& frame, const PngOptions& options) {
  const std::optional<glm::vec3> behind = color_behind(frame.settings);
  if (behind || backdrop_of(frame.scene, frame.settings.background).picture)
    return encode_png(preview(frame.color, options.exposure_ev, options.tone_map, behind));
  return encode_png(preview_with_alpha(frame.color, options.exposure_ev, options.tone_map));
}

void write_png(const std::filesystem::path& file, const FrameResult& frame, const PngOptions& options) {
  check_writable(file);
  write_text(file, encode_png(frame, options));
}

}  // namespace pinocchio
