// A frame's cost and its picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "pinocchio/conversion.h"
#include "pinocchio/exr.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"
#include "pinocchio/motion.h"
#include "pinocchio/progress.h"
#include "pinocchio/ray_counts.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"
#include "pinocchio/surface_images.h"
#include "pinocchio/tone_map.h"
#include "pinocchio/view.h"

namespace pinocchio {

// The stages of a frame, in the order a frame passes them; names as in statistics and traces. The first frame
// of a pose has the times of `pose` (posed, at_time) and `trees`, which may lie before it.
enum class Stage {
  pose,
  trees,
  raster,
  readback,
  trace_shadow,
  trace_reflection,
  upload,
  composite,
  present
};
inline constexpr std::array<std::string_view, 9> kStageNames{"pose",     "trees",        "raster",
                                                             "readback", "trace_shadow", "trace_reflection",
                                                             "upload",   "composite",    "present"};
// The processor that does a stage of frames of these settings; empty for transfers and the display.
[[nodiscard]] inline std::optional<Processor> processor_of(Stage stage, const Settings& settings) {
  switch (stage) {
    case Stage::raster:
      return settings.visibility;
    case Stage::pose:
    case Stage::trees:
    case Stage::trace_shadow:
    case Stage::trace_reflection:
      return Processor::cpu;
    case Stage::composite:  // with visibility gpu and composite cpu, the GPU copies the CPU's picture
      return settings.uses_gpu() ? Processor::gpu : Processor::cpu;
    case Stage::readback:
    case Stage::upload:
    case Stage::present:
      break;
  }
  return std::nullopt;
}

// The channels between the processors: the first four go from GPU to CPU, the others back.
enum class Channel { ids, normals, gbuffer, phong, traced_ids, mask, reflection, picture };
inline constexpr std::array<std::string_view, 8> kChannelNames{
    "ids", "normals", "gbuffer", "phong", "traced_ids", "mask", "reflection", "picture"};
[[nodiscard]] constexpr bool goes_to_cpu(Channel channel) {
  return channel < Channel::traced_ids;
}

// The time of some work, in seconds of the steady clock.
struct Span {
  double begin_s = 0.0, end_s = 0.0;

  [[nodiscard]] double ms() const { return 1e3 * (end_s - begin_s); }
};

// The cost of one frame.
struct FrameRecord {
  std::uint64_t number = 0;                       // of the frame, in the order of requests
  std::array<Span, kStageNames.size()> stages{};  // empty: the schedule has no such stage
  std::array<std::optional<Processor>, kStageNames.size()> processors{};  // processor_of each stage
  Span frame;              // from reading the camera to delivering the picture
  int latency_frames = 0;  // frames that began in between
  int age_frames = 0;      // how much older the shown mask and reflection are
  std::array<std::size_t, kChannelNames.size()> bytes{};
  RayCounts rays;

  [[nodiscard]] Span& operator[](Stage stage) { return stages[as_size(stage)]; }
  [[nodiscard]] const Span& operator[](Stage stage) const { return stages[as_size(stage)]; }
  [[nodiscard]] std::size_t& operator[](Channel channel) { return bytes[as_size(channel)]; }
  [[nodiscard]] std::size_t operator[](Channel channel) const { return bytes[as_size(channel)]; }
  // The sum of all channels to the CPU, or to the GPU.
  [[nodiscard]] std::size_t bytes_to_cpu() const { return sum_bytes(true); }
  [[nodiscard]] std::size_t bytes_to_gpu() const { return sum_bytes(false); }

 private:
  [[nodiscard]] std::size_t sum_bytes(bool to_cpu) const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      if (goes_to_cpu(static_cast<Channel>(i)) == to_cpu) sum += bytes[i];
    return sum;
  }
};

// A finished picture on the CPU, with its inputs. Row 0 is the top row.
struct FrameResult {
  Image<glm::vec4> color;  // linear RGBA, mean of the samples; A: the covered share of the pixel
  // The first sample, at the pixels' centres:
  Image<std::uint32_t> ids;     // kNoTriangle where nothing is seen
  MaskImage mask;               // 0 bits if no light casts, or the frame's own mask is not traced yet
  Image<glm::vec3> reflection;  // linear light; empty in the same cases
  Scene scene;                  // the inputs: the scene, ...
  View view;                    // ... the view ...
  Settings settings;            // ... and the settings
  FrameRecord record;           // without the GPU's times, which are known later
  std::size_t holes = 0;        // reprojected: pixels without a value in any older frame
  // The frame that the layer `motion` leads to, which the caller sets. None: to this one, so that it is 0.
  std::optional<MotionTo> motion{};
  // With Settings::average_layers and several samples: the layers N and Albedo, means over the samples; a
  // sample that hits nothing counts as 0. Else empty.
  Image<glm::vec3> mean_normal{}, mean_albedo{};
};

// The properties of the frame's visible points, computed from its ids.
[[nodiscard]] SurfaceImages surfaces_of(const FrameResult& frame);

// Copies its shadow mask to `to`: `bytes` for each pixel, slot i in bit i % 8 of byte i / 8. One byte holds
// eight casting lights; MaskImage::bytes_for() says how many hold all.
void unpack_mask(const FrameResult& frame, std::uint8_t* to, std::size_t bytes = 1);

struct ExrOptions {
  std::string layers = "all";  // or "none", or EXR names of kLayers with commas between
  ExrCompression compression = ExrCompression::zip;
  // The render time, for the header. Without it the same picture has the same bytes on every machine
  // (ExrFile::reproducible).
  std::optional<double> render_s{};
  // For the header: the frame's number in an animation, and the frames per second.
  int frame = 0;
  int frames_per_second = 24;
  std::optional<double> time_s{};  // time in the animation; none: frame / frames_per_second
  std::string inputs{};            // for the header: the picture's inputs (the program writes JSON)
};

// Writes the picture with its layers and attributes, one part, scene-linear, whole or not at all. Throws
// EnvironmentError where it cannot be written. Source: OpenEXR's standard attributes. Phase "write".
void write_exr(const std::filesystem::path& file, const FrameResult& frame, const ExrOptions& options = {},
               Progress* progress = nullptr);
// The header that write_exr would write, and its channels without values: to check whether a file has this
// frame.
[[nodiscard]] ExrFile exr_header(const FrameResult& frame, const ExrOptions& options = {});

struct PngOptions {
  float exposure_ev = 0.0f;  // stops brighter
  ToneMap tone_map = ToneMap::clip;
};
// The colour as a screen shows it, as a PNG file: sRGB, 8 bits. Where neither an environment nor a colour is
// behind the scene, with alpha, which is not multiplied into the colour. Throws EnvironmentError.
[[nodiscard]] std::string encode_png(const FrameResult& frame, const PngOptions& options = {});
// Writes it whole or not at all. Throws EnvironmentError where it cannot be written.
void write_png(const std::filesystem::path& file, const FrameResult& frame, const PngOptions& options = {});

}  // namespace pinocchio
