// A frame as an EXR.
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/image/codecs/exr_bands.h"
#include "core/output/frame_exr.h"
#include "core/parallel/workers.h"
#include "hybrid/frame/lines.h"
#include "hybrid/settings/json.h"

namespace pinocchio {
namespace {

AovSet aovs_of(const FrameResult& frame, const ExrOptions& options) {
  const Expected<AovSet> wanted = parse_aovs(options.layers);
  if (!wanted) throw std::invalid_argument(wanted.error().message());
  AovSet aovs = *wanted;
  // A reprojected picture shows an older frame's, warped; its own are not traced yet.
  if (frame.record.age_frames > 0)
    for (const LayerRow& row : kLayers)
      if (row.window.traced) aovs.erase(std::string(row.exr.name));
  return aovs;
}

FrameOutput output_of(const FrameResult& frame, const ExrOptions& options) {
  return {.size = frame.view.size,
          .part = frame.view.box(),
          .scene = frame.scene,
          .camera = frame.view.camera,
          .write_lines = [&frame](int y0, int y1, const FrameArrays& to) { write_lines(frame, y0, y1, to); },
          .plan_json = to_json(frame.settings, false).dump(),
          .render_s = options.render_s,
          .samples_per_pixel = frame.settings.spp,
          .frame = options.frame,
          .frames_per_second = options.frames_per_second,
          .time_s = options.time_s,
          .age_frames = frame.record.age_frames,
          .has_rays = frame.view.rays != nullptr,
          .inputs = options.inputs};
}

ExrFile header_of(const FrameOutput& output, const AovSet& aovs, const ExrOptions& options) {
  ExrFile header = frame_exr(output, aovs, 0, 0);
  header.compression = options.compression;
  return header;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const FrameResult& frame, const ExrOptions& options,
               Progress* progress) {
  const AovSet aovs = aovs_of(frame, options);
  const FrameOutput output = output_of(frame, options);
  const auto band = [&](int y0, int y1) { return frame_channels(output, aovs, y0, y1); };
  Workers workers(frame.settings.threads);
  write_exr(file, header_of(output, aovs, options), workers, band, progress);
}

ExrFile exr_header(const FrameResult& frame, const ExrOptions& options) {
  return header_of(output_of(frame, options), aovs_of(frame, options), options);
}

}  // namespace pinocchio
