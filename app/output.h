#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/named_files.h"
#include "app/numbered.h"
#include "app/parse.h"
#include "core/image/tonemap.h"
#include "core/parallel/workers.h"
#include "pinocchio/renderer.h"
#include "pinocchio/scene.h"

namespace CLI {
class App;
}

namespace pinocchio::app {

// -o, --preview, --aov, --compression, --exposure, --tone-map, --deterministic, --skip-existing
struct OutputOptions {
  std::string exr;      // "####" is the frame's number
  std::string preview;  // PNG
  std::string aovs = "all";
  ExrCompression compression = ExrCompression::zip;
  float exposure_ev = 0.0f;
  ToneMap tone_map = ToneMap::clip;
  bool deterministic = false;
  bool skip_existing = false;
  std::string inputs;  // inputs_json of what is drawn: goes into the files
};

// Which frame of an animation it is, and when.
struct FrameHeader {
  int number = 0;
  int fps = 24;
  double time_s = 0.0;
};

// What the frame's EXR is written by, but for the time that it took.
[[nodiscard]] ExrOptions exr_options(const OutputOptions& options, const FrameHeader& frame);

// Describes what a frame's pixels depend on beside its settings, camera and lights: the bytes of the scene's
// files and of its environment, and whether the reference draws it. Reads these files.
[[nodiscard]] std::string inputs_json(const Scene& scene, bool precise);

// Describes a preview: the EXR's header as JSON, the exposure and the tone curve. It goes into the PNG.
[[nodiscard]] std::string preview_text(const OutputOptions& options, const ExrFile& header);

// A frame on its way to its files.
struct DrawnFrame {
  FrameHeader header;
  FrameResult picture;
  double render_s = 0.0;
};

// Of what is shown or previewed.
void add_tone_map_option(CLI::App& verb, ToneMap& curve);
void add_output_options(CLI::App& verb, OutputOptions& options);

void write_json(const std::filesystem::path& file, const nlohmann::json& json);

// Makes the folder and those above it that are missing. Ends the verb with kFailed where it cannot.
void make_folder(const std::filesystem::path& folder);

// Ends the verb before anything is drawn: with kUsage where several frames would go to one file, with
// kFailed where a file cannot be written.
void check_outputs(const OutputOptions& options, const FrameRange& range);

// `other`, which is written beside these frames, and those of their files that can be the same as another,
// each with the option that names it.
[[nodiscard]] std::vector<NamedFile> output_files(const OutputOptions& options, const FrameRange& range,
                                                  const NamedFile& other);

// Whether an EXR with the shadow mask in it is asked for.
[[nodiscard]] bool keeps_mask(const OutputOptions& options);

// Writes one frame to the files that the options name, each whole or not at all.
void write_outputs(const OutputOptions& options, const DrawnFrame& frame);

}  // namespace pinocchio::app
