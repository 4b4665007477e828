#include "app/output.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>
#include <type_traits>
#include <variant>

#include "app/errors.h"
#include "app/parse.h"
#include "core/image/atomic_file.h"
#include "core/image/checksum.h"
#include "core/image/png.h"
#include "core/image/tonemap.h"
#include "core/output/aovs.h"

namespace pinocchio::app {
namespace {

std::string check_extension(const std::string& file, const std::string& extension) {
  if (std::filesystem::path(file).extension() == extension) return {};
  return "'" + file + "' does not end in " + extension;
}

constexpr float kMostStops = 64.0f;

// ASCII alone, because PNG's text is Latin-1 and file names may not be UTF-8.
std::string dumped(const nlohmann::json& json) {
  return json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

// CLI::Range lets NaN through.
std::string is_stops(const std::string& text) {
  const std::optional<float> value = parse_float(text);
  if (value && std::abs(*value) <= kMostStops) return {};
  return "'" + text + "' is no number of stops from -64 to 64";
}

}  // namespace

void add_tone_map_option(CLI::App& verb, ToneMap& curve) {
  verb.add_option_function<std::string>(
          "--tone-map",
          [&curve](const std::string& text) {
            const auto found = std::ranges::find(kToneMapNames, text);
            if (found == kToneMapNames.end())
              throw CLI::ValidationError("--tone-map", "'" + text + "' is not clip, reinhard or aces");
            curve = static_cast<ToneMap>(found - kToneMapNames.begin());
          },
          "how light brighter than white is shown (clip)")
      ->type_name("clip|reinhard|aces");
}

void add_output_options(CLI::App& verb, OutputOptions& options) {
  verb.add_option("-o,--output", options.exr,
                  "the picture and its layers, scene-linear; #### is the frame's number")
      ->type_name("FILE.exr")
      ->check([](const std::string& file) { return check_extension(file, ".exr"); });
  verb.add_option("--preview", options.preview, "the picture as a screen shows it (sRGB, 8 bits)")
      ->type_name("FILE.png")
      ->check([](const std::string& file) { return check_extension(file, ".png"); });
  verb.add_option("--aov", options.aovs,
                  "EXR layers: all, none or some of Z,P,N,Albedo,id,shadow,reflection (all)")
      ->type_name("LIST")
      ->check([](const std::string& text) {
        const Expected<AovSet> aovs = parse_aovs(text);
        return aovs ? std::string() : aovs.error().message();
      });
  std::string type;
  for (const std::string_view name : kExrCompressionNames)
    type += (type.empty() ? "" : "|") + std::string(name);
  verb.add_option_function<std::string>(
          "--compression",
          [&options](const std::string& text) {
            const auto found = std::ranges::find(kExrCompressionNames, text);
            if (found == kExrCompressionNames.end())
              throw CLI::ValidationError("--compression",
                                         "'" + text + "' is not zip, zips, piz, rle or none");
            options.compression = static_cast<ExrCompression>(found - kExrCompressionNames.begin());
          },
          "how the EXR is packed, without loss all of them (zip)")
      ->type_name(type);
  verb.add_option("--exposure", options.exposure_ev, "of the preview, in stops (0)")
      ->check(CLI::Validator(is_stops, "-64 to 64"));
  add_tone_map_option(verb, options.tone_map);
  verb.add_flag("--deterministic", options.deterministic,
                "leave the render time out of the EXR: the same file, whatever machine draws it");
  verb.add_flag("--skip-existing", options.skip_existing,
                "leave out frames whose files are whole and say that they were drawn by the same settings "
                "from the same "
                "files");
}

void write_json(const std::filesystem::path& file, const nlohmann::json& json) {
  write_text(file, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Exit(kFailed, folder.string() + ": cannot be made a folder (" + error.message() +
                            "); name one that can be written with -o DIR");
}

void check_outputs(const OutputOptions& options, const FrameRange& range) {
  for (const std::string& pattern : {options.exr, options.preview}) {
    if (pattern.empty()) continue;
    if (range.count() > 1 && pattern.find('#') == std::string::npos)
      throw Exit(kUsage, pattern + ": would hold " + std::to_string(range.count()) +
                             " frames; put #### where the frame's number goes");
    check_writable(numbered(pattern, range.first));
  }
}

std::vector<NamedFile> output_files(const OutputOptions& options, const FrameRange& range,
                                    const NamedFile& other) {
  std::vector<NamedFile> files{other};
  for (const auto& [role, pattern] :
       {std::pair("-o", options.exr), std::pair("--preview", options.preview)}) {
    if (pattern.empty()) continue;
    for (const int number : numbers_in_use(pattern, range, other.file))
      files.push_back({role, numbered(pattern, number)});
  }
  return files;
}

ExrOptions exr_options(const OutputOptions& options, const FrameHeader& frame) {
  return {.layers = options.aovs,
          .compression = options.compression,
          .frame = frame.number,
          .frames_per_second = frame.fps,
          .time_s = frame.time_s,
          .inputs = options.inputs};
}

std::string inputs_json(const Scene& scene, bool precise) {
  nlohmann::json inputs{{"precise", precise}, {"files", nlohmann::json::array()}};
  const auto add = [&](const std::string& file) {
    const std::optional<std::string> content = fingerprint(file);
    inputs["files"].push_back({{"name", std::filesystem::path(file).filename().string()},
                               {"content", content ? nlohmann::json(*content) : nullptr}});
  };
  for (const std::string& file : scene.source_files) add(file);
  if (scene.environment) add(scene.environment->source());
  return dumped(inputs);
}

std::string preview_text(const OutputOptions& options, const ExrFile& header) {
  const PixelBox& part = header.data_window;
  nlohmann::json json{
      {"exposure", options.exposure_ev},
      {"toneMap", kToneMapNames[static_cast<std::size_t>(options.tone_map)]},
      {"displaySize", {header.display_size.x, header.display_size.y}},
      {"dataWindow", {part.lo.x, part.lo.y, part.hi.x, part.hi.y}},
  };
  for (const auto& [name, attribute] : header.attributes)
    std::visit(
        [&json, &name](const auto& value) {
          using Value = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, glm::mat4>)
            json[name] = std::vector<float>(&value[0][0], &value[0][0] + 16);
          else if constexpr (std::is_same_v<Value, ExrRational>)
            json[name] = {value.numerator, value.denominator};
          else
            json[name] = value;
        },
        attribute);
  return dumped(json);
}

bool keeps_mask(const OutputOptions& options) {
  return !options.exr.empty() && parse_aovs(options.aovs)->contains("shadow");
}

void write_outputs(const OutputOptions& options, const DrawnFrame& frame) {
  const ExrOptions same_for_all = exr_options(options, frame.header);
  if (!options.exr.empty()) {
    ExrOptions exr = same_for_all;
    if (!options.deterministic) exr.render_s = frame.render_s;
    write_exr(numbered(options.exr, frame.header.number), frame.picture, exr);
  }
  if (!options.preview.empty())
    write_png(numbered(options.preview, frame.header.number),
              preview(frame.picture.color, options.exposure_ev, options.tone_map),
              preview_text(options, exr_header(frame.picture, same_for_all)));
}

}  // namespace pinocchio::app
