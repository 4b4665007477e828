#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/named_files.h"
#include "app/cli/numbered.h"
#include "app/cli/options.h"
#include "app/cli/parse.h"
#include "app/run/animation.h"
#include "core/image/tonemap.h"
#include "core/parallel/workers.h"
#include "pinocchio/load.h"
#include "pinocchio/renderer.h"
#include "pinocchio/scene.h"

namespace CLI {
class App;
}

namespace pinocchio::app {

// -o, --preview, --raw, --aov, --compression, --exposure, --tone-map, --deterministic, --skip-existing
struct OutputOptions {
  std::string exr;      // "####" stands for the frame's number
  std::string preview;  // PNG
  bool raw = false;     // frames go to standard output
  std::string aovs = "all";
  ExrCompression compression = ExrCompression::zip;
  float exposure_ev = 0.0f;
  ToneMap tone_map = ToneMap::clip;
  bool deterministic = false;
  bool skip_existing = false;
  bool motion_to_former = false;  // the layer `motion` leads to the former frame, not to the next
  std::string inputs;             // inputs_json of the scene, for the files' headers
};

// A frame's number and time.
struct FrameHeader {
  int number = 0;
  int fps = 24;
  double time_s = 0.0;
  std::optional<CameraFrame> motion_to{};  // the frame that the layer `motion` leads to, where it is kept
};

// How the frame's EXR is written, without the render time.
[[nodiscard]] ExrOptions exr_options(const OutputOptions& options, const FrameHeader& frame);

// Describes what a frame's pixels depend on beside its settings, camera and lights: the bytes of the scene's
// files and of its environment, how they are read, and whether the reference draws it. Reads these files.
[[nodiscard]] std::string inputs_json(const Scene& scene, const DrawOptions& draw,
                                      const OutputOptions& output);

// Describes a preview: the EXR's header as JSON, the exposure and the tone curve. It goes into the PNG.
[[nodiscard]] std::string preview_text(const OutputOptions& options, const ExrFile& header);

// A frame on its way to its files.
struct DrawnFrame {
  FrameHeader header;
  FrameResult picture;
  double render_s = 0.0;
};

// --exposure and --tone-map.
void add_display_options(CLI::App& verb, float& exposure_ev, ToneMap& curve, int most_stops);
void add_output_options(CLI::App& verb, OutputOptions& options);

// Indented. Bytes that are not UTF-8, as names of files may have, are replaced.
[[nodiscard]] std::string json_text(const nlohmann::json& json);
void write_json(const std::filesystem::path& file, const nlohmann::json& json);

// The error message for a file whose name does not end in `extension`; empty where it does.
[[nodiscard]] std::string ending_error(const std::string& file, const std::string& extension);

// Makes the folder and those above it that are missing. Ends the verb with kFailed where it cannot; the line
// says that `option` names another one.
void make_folder(const std::filesystem::path& folder, const char* option);

// Ends the verb before anything is drawn: with kUsage where several frames would be written to one file, with
// kFailed where a file cannot be written.
void check_outputs(const OutputOptions& options, const FrameRange& range);

// The files of the frames that exist or may be the same as one of `others`, and the others, which are written
// too; each with the option that names it.
[[nodiscard]] std::vector<NamedFile> output_files(const OutputOptions& options, const FrameRange& range,
                                                  const std::vector<NamedFile>& others);

// Whether an EXR is written that has the shadow mask, or the layer motion.
[[nodiscard]] bool keeps_mask(const OutputOptions& options);
[[nodiscard]] bool keeps_motion(const OutputOptions& options);

// Writes one frame to the files that the options name, each whole or not at all.
void write_outputs(const OutputOptions& options, const DrawnFrame& frame);

}  // namespace pinocchio::app
