#include "app/run/output.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>
#include <type_traits>
#include <variant>

#include "app/cli/add_option.h"
#include "app/cli/errors.h"
#include "app/cli/groups.h"
#include "core/files/atomic_file.h"
#include "core/files/checksum.h"
#include "core/image/codecs/png.h"
#include "core/output/aovs.h"
#include "hybrid/frame/samples.h"
#include "pinocchio/names.h"
#include "pinocchio/studio.h"

namespace pinocchio::app {
namespace {

auto ends_in(const char* extension) {
  return [extension](const std::string& file) { return ending_error(file, extension); };
}

// ASCII alone, because PNG's text is Latin-1 and file names may not be UTF-8.
std::string ascii_json(const nlohmann::json& json) {
  return json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

// The inputs of all frames, and for the layer `motion` the other frame's time and what of its camera may
// differ from this frame's: another turntable, path or step leads the same picture's points elsewhere.
std::string inputs_of(const OutputOptions& options, const FrameHeader& frame) {
  if (!frame.motion_to) return options.inputs;
  const auto numbers = [](const glm::vec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
  const Camera& camera = frame.motion_to->camera;
  nlohmann::json inputs = nlohmann::json::parse(options.inputs);
  inputs["motionFrame"] = {
      {"time", frame.motion_to->time_s}, {"eye", numbers(camera.eye)}, {"target", numbers(camera.target)},
      {"up", numbers(camera.up)},        {"fov", camera.fov_deg},      {"height", camera.height}};
  return ascii_json(inputs);
}

}  // namespace

void add_display_options(CLI::App& verb, float& exposure_ev, ToneMap& curve, int most_stops) {
  begin_group(verb, kPictureGroup);
  add_parsed(verb, "--exposure", "exposure of what is shown or previewed, in stops (0)",
             "a number of stops from " + std::to_string(-most_stops) + " to " + std::to_string(most_stops),
             number_within(-1.0f * most_stops, 1.0f * most_stops), exposure_ev)
      ->type_name("STOPS");
  add_choice(verb, "--tone-map", "how light brighter than white is shown (clip)", kToneMapNames, curve);
}

void add_output_options(CLI::App& verb, OutputOptions& options) {
  begin_group(verb, kPictureGroup);
  verb.add_option("-o,--output", options.exr,
                  "the picture and its layers, scene-linear; #### stands for the frame's number")
      ->type_name("FILE.exr")
      ->check(ends_in(".exr"));
  verb.add_option("--preview", options.preview,
                  "the picture as a screen shows it (sRGB, 8 bits; with alpha on a transparent background)")
      ->type_name("FILE.png")
      ->check(ends_in(".png"));
  verb.add_option_function<std::string>(
          "--raw", [&options](const std::string&) { options.raw = true; },
          "-: write the frames to standard output, one after the other, as a screen shows them: rows from "
          "the "
          "top, 3 bytes a pixel (ffmpeg -f rawvideo -pix_fmt rgb24 -s WxH -i -), 4 with --background "
          "transparent (rgba)")
      ->type_name("-")
      ->check(CLI::IsMember({"-"}));
  verb.add_option("--aov", options.aovs,
                  "EXR layers: all, none or some of " + aov_names() +
                      ", with commas between; all leaves out motion and ids other than the triangle's (all)")
      ->type_name("LIST")
      ->check([](const std::string& text) {
        const Expected<AovSet> aovs = parse_aovs(text);
        return aovs ? std::string() : aovs.error().message();
      });
  verb.add_option_function<std::string>(
          "--motion-to",
          [&options](const std::string& frame) { options.motion_to_former = frame == "former"; },
          "the frame that the layer motion leads to: next or former (next)")
      ->type_name("next|former")
      ->check(CLI::IsMember({"next", "former"}));
  add_choice(verb, "--compression", "compression of the EXR, lossless (zip)", kExrCompressionNames,
             options.compression);
  add_display_options(verb, options.exposure_ev, options.tone_map, 64);
  verb.add_flag(
      "--deterministic", options.deterministic,
      "leave the render time out of the EXR, and pack it so that every machine writes the same file; slower");
  verb.add_flag(
      "--skip-existing", options.skip_existing,
      "skip frames whose files are complete and were drawn by the same settings from the same files");
  begin_group(verb, kOtherGroup);
}

std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string ending_error(const std::string& file, const std::string& extension) {
  if (std::filesystem::path(file).extension() == extension) return {};
  return "'" + file + "' does not end in " + extension;
}

void write_json(const std::filesystem::path& file, const nlohmann::json& json) {
  write_text(file, json_text(json));
}

void make_folder(const std::filesystem::path& folder, const char* option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Exit(kFailed, folder.string() + ": the folder cannot be made (" + error.message() +
                            "); give another one with " + option);
}

void check_outputs(const OutputOptions& options, const FrameRange& range) {
  for (const std::string& pattern : {options.exr, options.preview}) {
    if (pattern.empty()) continue;
    if (range.count() > 1 && number_place(pattern).empty())
      throw Exit(kUsage, pattern + ": one file cannot hold " + std::to_string(range.count()) +
                             " frames; put #### in place of the frame's number");
    check_writable(numbered(pattern, range.first));
  }
}

std::vector<NamedFile> output_files(const OutputOptions& options, const FrameRange& range,
                                    const std::vector<NamedFile>& others) {
  std::vector<NamedFile> files = others;
  std::vector<std::filesystem::path> names;
  for (const NamedFile& other : others) names.push_back(other.file);
  for (const auto& [role, pattern] :
       {std::pair("-o", options.exr), std::pair("--preview", options.preview)}) {
    if (pattern.empty()) continue;
    for (const int number : numbers_in_use(pattern, range, names))
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
          .inputs = inputs_of(options, frame)};
}

std::string inputs_json(const Scene& scene, const DrawOptions& draw, const OutputOptions& output) {
  nlohmann::json inputs{{"precise", draw.precise},
                        {"shading", name_of(kShadingNames, draw.load.shading)},
                        {"files", nlohmann::json::array()}};
  if (!draw.load.animation.empty()) inputs["animation"] = draw.load.animation;
  if (draw.load.up_axis != UpAxis::y) inputs["upAxis"] = name_of(kUpAxisNames, draw.load.up_axis);
  if (!draw.load.variant.empty()) inputs["variant"] = draw.load.variant;
  if (draw.load.point_size > 0.0f) inputs["pointSize"] = draw.load.point_size;
  if (draw.load.line_width > 0.0f) inputs["lineWidth"] = draw.load.line_width;
  if (keeps_motion(output)) inputs["motionTo"] = output.motion_to_former ? "former" : "next";
  const auto add = [&](const std::string& file) {
    const std::optional<std::string> content = fingerprint(file);
    inputs["files"].push_back({{"name", std::filesystem::path(file).filename().string()},
                               {"content", content ? nlohmann::json(*content) : nullptr}});
  };
  for (const std::string& file : scene.source_files) add(file);
  if (has_studio_sky(scene))
    inputs["studio"] = true;
  else if (scene.environment)
    add(scene.environment->source());
  return ascii_json(inputs);
}

std::string preview_text(const OutputOptions& options, const ExrFile& header) {
  const PixelBox& part = header.data_window;
  nlohmann::json json{
      {"exposure", options.exposure_ev},
      {"toneMap", name_of(kToneMapNames, options.tone_map)},
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
  return ascii_json(json);
}

bool keeps_mask(const OutputOptions& options) {
  return !options.exr.empty() && parse_aovs(options.aovs)->contains("shadow");
}

bool keeps_motion(const OutputOptions& options) {
  return !options.exr.empty() && parse_aovs(options.aovs)->contains("motion");
}

namespace {

// 8 bits a component, rows from the top.
template <class Pixel>
void write_raw(const Image<Pixel>& picture) {
  const std::span<const Pixel> pixels = picture.pixels();
  if (std::fwrite(pixels.data(), sizeof(Pixel), pixels.size(), stdout) != pixels.size() ||
      std::fflush(stdout) != 0)
    throw EnvironmentError("--raw -: standard output cannot be written; has its reader ended?");
}

}  // namespace

void write_outputs(const OutputOptions& options, const DrawnFrame& frame) {
  const ExrOptions same_for_all = exr_options(options, frame.header);
  if (!options.exr.empty()) {
    ExrOptions exr = same_for_all;
    if (!options.deterministic) exr.render_s = frame.render_s;
    write_exr(numbered(options.exr, frame.header.number), frame.picture, exr);
  }
  const auto write_shown = [&](const auto& picture) {
    if (options.raw) write_raw(picture);
    if (!options.preview.empty())
      write_png(numbered(options.preview, frame.header.number), picture,
                preview_text(options, exr_header(frame.picture, same_for_all)));
  };
  if (!options.raw && options.preview.empty()) return;
  const Image<glm::vec4>& color = frame.picture.color;
  if (frame.picture.settings.background.value.is_transparent())
    write_shown(preview_with_alpha(color, options.exposure_ev, options.tone_map));
  else
    write_shown(preview(color, options.exposure_ev, options.tone_map, color_behind(frame.picture.settings)));
}

}  // namespace pinocchio::app
