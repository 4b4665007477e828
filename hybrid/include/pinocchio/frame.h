// What a frame cost, and what it shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "pinocchio/exr.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"
#include "pinocchio/progress.h"
#include "pinocchio/ray_counts.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"
#include "pinocchio/surface_images.h"
#include "pinocchio/view.h"

namespace pinocchio {

// The stages of a frame, in the order a frame goes through them; names as in the figures.
enum class Stage { raster, readback, trace_shadow, trace_reflection, upload, composite, present };
inline constexpr std::array<std::string_view, 7> kStageNames{
    "raster", "readback", "trace_shadow", "trace_reflection", "upload", "composite", "present"};
// The processor that does a stage of frames of these settings; empty for transfers and the display.
[[nodiscard]] std::optional<Processor> processor_of(Stage stage, const Settings& settings);

// What travels: the first four from GPU to CPU, the others back.
enum class Channel { ids, normals, gbuffer, phong, traced_ids, mask, reflection, picture };
inline constexpr std::array<std::string_view, 8> kChannelNames{
    "ids", "normals", "gbuffer", "phong", "traced_ids", "mask", "reflection", "picture"};
[[nodiscard]] constexpr bool goes_to_cpu(Channel channel) {
  return channel < Channel::traced_ids;
}

// When something was done, seconds of the steady clock.
struct Span {
  double begin_s = 0.0, end_s = 0.0;

  [[nodiscard]] double ms() const { return 1e3 * (end_s - begin_s); }
};

// What one frame cost.
struct FrameRecord {
  std::uint64_t number = 0;                       // of the frame, in the order they were asked for
  std::array<Span, kStageNames.size()> stages{};  // empty: the schedule has no such stage
  std::array<std::optional<Processor>, kStageNames.size()> processors{};  // processor_of each stage
  Span frame;              // camera sampled to picture delivered
  int latency_frames = 0;  // frames begun between the two
  int age_frames = 0;      // how much older the mask and reflection shown are
  std::array<std::size_t, kChannelNames.size()> bytes{};
  RayCounts rays;

  [[nodiscard]] Span& operator[](Stage stage) { return stages[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] const Span& operator[](Stage stage) const { return stages[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] std::size_t& operator[](Channel channel) { return bytes[static_cast<std::size_t>(channel)]; }
  [[nodiscard]] std::size_t operator[](Channel channel) const {
    return bytes[static_cast<std::size_t>(channel)];
  }
  // Of all that goes to the CPU, or to the GPU.
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

// A finished picture on the CPU, with what it was made of. Row 0 is the top row.
struct FrameResult {
  Image<glm::vec4> color;  // linear RGBA, mean of the samples; A: how much of the pixel is covered
  // Of the first sample, at the pixels' centres:
  Image<std::uint32_t> ids;     // kNoTriangle where nothing is seen
  MaskImage mask;               // 0 bits where no light casts, or the frame's own is not traced yet
  Image<glm::vec3> reflection;  // linear light; empty, likewise
  Scene scene;                  // what it shows, ...
  View view;                    // ... from where
  Settings settings;            // that it was drawn by
  FrameRecord record;           // without what is known later only: the GPU's times
  std::size_t holes = 0;        // reprojected: pixels that no older frame had an answer for
};

// What the frame's visible points are like, from its ids.
[[nodiscard]] SurfaceImages surfaces_of(const FrameResult& frame);

// Its shadow mask, a byte a pixel whatever its bits; `to` has room for all.
void unpack_mask(const FrameResult& frame, std::uint8_t* to);

struct ExrOptions {
  std::string layers =
      "all";  // or "none", or some of Z, P, N, Albedo, id, shadow, reflection with commas between
  ExrCompression compression = ExrCompression::zip;
  std::optional<double> render_s{};  // what it took, for its header
  // For its header, too: which frame of an animation it is, and how many there are a second.
  int frame = 0;
  int frames_per_second = 24;
  std::optional<double> time_s{};  // of the animation; else frame / frames_per_second
  std::string inputs{};            // likewise: what the picture was made of (the program writes JSON)
};

// The picture with its layers and attributes, one part, scene-linear. Whole or not at all; throws
// EnvironmentError where it cannot be written. Source: OpenEXR's standard attributes. Phase "write".
void write_exr(const std::filesystem::path& file, const FrameResult& frame, const ExrOptions& options = {},
               Progress* progress = nullptr);
// The header that it would get, and its channels without values: for those who look whether a file is this
// frame's.
[[nodiscard]] ExrFile exr_header(const FrameResult& frame, const ExrOptions& options = {});

}  // namespace pinocchio
