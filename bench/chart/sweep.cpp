#include "bench/chart/sweep.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace pinocchio::chart {
namespace {

// A preset or a field of the settings, and its value.
using Option = std::pair<std::string_view, std::string>;
using Options = std::vector<Option>;

// A value of an axis: its name on the chart, and the settings for it.
struct Value {
  std::string name;
  Options options;
  bool quick = true;  // also with --quick
};
using Values = std::vector<Value>;
constexpr bool kFull = false;

Options operator+(Options a, const Options& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Values designs(const SweepRequest&) {
  return {{"1", {}},
          {"2", {{"design", "2"}}},
          {"1 slides", {{"plan", "slides"}}},
          {"2 slides", {{"design", "2"}, {"plan", "slides"}}},
          {"raytrace", {{"mode", "raytrace"}}},
          {"raster", {{"mode", "raster"}}}};
}

Values exchanges(const SweepRequest&) {
  return {{"1 sync", {}},
          {"1 pipelined", {{"exchange", "pipelined"}}},
          {"1 reproject", {{"exchange", "reproject"}}},
          {"2 sync", {{"design", "2"}, {"exchange", "sync"}}},
          {"2 pipelined", {{"design", "2"}, {"exchange", "pipelined"}}}};
}

Values visibilities(const SweepRequest&) {
  return {{"raster", {{"visibility", "gpu"}}}, {"rays", {{"visibility", "cpu"}}}};
}

// All values of a field.
Values choices_of(std::string_view field) {
  Values values;
  for (const std::string_view choice : find_field(field)->choices)
    if (choice != "none") values.push_back({std::string(choice), {{field, std::string(choice)}}});
  return values;
}

// All channels that are rounded for the transfer, in each format.
Values precisions(const SweepRequest&) {
  return {{"no exchange", {{"mode", "raytrace"}}},
          {"reflection float", {{"reflection", "float"}}},
          {"reflection half", {{"reflection", "half"}}},
          {"reflection shared exponent", {{"reflection", "rgb9e5"}}},
          {"reflection sRGB bytes", {{"reflection", "rgb8"}}},
          {"ids of 32 bits", {{"id_bits", "32"}}, kFull},
          {"packed normals beside", {{"normals", "true"}}, kFull},
          {"pictures of sRGB bytes", {{"design", "2"}}},
          {"128-bit surfaces beside", {{"design", "2"}, {"wide", "true"}}, kFull}};
}

Values scales(std::string_view field) {
  return {{"1", {{field, "1"}}}, {"1/2", {{field, "2"}}}, {"1/4", {{field, "4"}}}};
}

Values tiles(const SweepRequest&) {
  return {{"used", {{"tiles", "true"}}}, {"all", {{"tiles", "false"}}}};
}

Values depths(const SweepRequest& request) {
  Values values;
  for (const int depth : {0, 1, 2, 3, 4, 6})
    if (const std::string text = std::to_string(depth); depth < request.base.depth)
      values.push_back({text, {{"depth", text}}, depth <= 2});
  values.push_back({std::to_string(request.base.depth), {{"depth", std::to_string(request.base.depth)}}});
  return values;
}

// Mirrored rays with less light are not followed, and shadow rays for less light not traced.
Options cutoff(float least, const SweepRequest& request) {
  Settings s;
  s.throughput_cutoff = least;
  s.light_cutoff = least / static_cast<float>(std::max(request.stats.casting_lights, 1));
  Options options;
  for (const char* field : {"throughput_cutoff", "light_cutoff"})
    options.emplace_back(field, find_field(field)->text(s));
  return options;
}

Values cutoffs(const SweepRequest& request) {
  Values values{{"0", cutoff(0.0f, request)}};
  for (const int power : {13, 10, 8, 6, 4, 2})
    values.push_back({"1/" + std::to_string(1 << power),
                      cutoff(1.0f / static_cast<float>(1 << power), request),
                      power == 13 || power == 8 || power == 4});
  return values;
}

Values thread_counts(const SweepRequest& request) {
  Values values;
  for (int threads = 1; threads < request.cores; threads *= 2)
    values.push_back({std::to_string(threads), {{"threads", std::to_string(threads)}}});
  values.push_back({std::to_string(request.cores), {}});
  return values;
}

Values sample_counts(const SweepRequest&) {
  return {{"1", {}}, {"2", {{"spp", "2"}}, kFull}, {"4", {{"spp", "4"}}}, {"8", {{"spp", "8"}}, kFull}};
}

// Ways to light by a sky: by means, and by samples, which may be filtered.
Values skies(const SweepRequest& request) {
  if (!request.stats.environment) return {};
  const Options prefiltered{{"environment_light", "prefiltered"}}, sampled{{"environment_light", "sampled"}},
      filtered = sampled + Options{{"denoise", "true"}};
  const auto spp = [](const char* n) { return Options{{"spp", n}}; };
  return {{"prefiltered", prefiltered},
          {"prefiltered, 1 ray", prefiltered + Options{{"sky_occlusion", "1"}}, kFull},
          {"prefiltered, 8 rays", prefiltered + Options{{"sky_occlusion", "8"}}},
          {"sampled, 1", sampled},
          {"sampled, 4", sampled + spp("4")},
          {"sampled, 16", sampled + spp("16"), kFull},
          {"sampled, 64", sampled + spp("64"), kFull},
          {"filtered, 1", filtered},
          {"filtered, 4", filtered + spp("4")},
          {"filtered, 16", filtered + spp("16"), kFull}};
}

Values glass(const SweepRequest& request) {
  return request.stats.transmits() ? choices_of("glass_shadows") : Values{};
}

Values combinations(const SweepRequest& request) {
  const auto shrunk = [](const char* scale, const char* format) {
    return Options{{"mask_scale", scale}, {"reflection_scale", scale}, {"reflection", format}};
  };
  const Options half = shrunk("2", "rgb9e5"), quarter = shrunk("4", "rgb8"),
                shallow = Options{{"depth", "1"}} + cutoff(0x1p-6f, request),
                pipelined{{"exchange", "pipelined"}}, reproject{{"exchange", "reproject"}};
  return {{"default", {}},
          {"half", half},
          {"quarter", quarter},
          {"shallow-half", shallow + half},
          {"shallow", shallow, kFull},
          {"shallow-quarter", shallow + quarter, kFull},
          {"half-pipelined", half + pipelined, kFull},
          {"half-reproject", half + reproject, kFull},
          {"shallow-quarter-reproject", shallow + quarter + reproject, kFull}};
}

// Masks that hold the casting lights, and narrower ones: the light of the others travels with mirrored light.
Values mask_widths(const SweepRequest& request) {
  Values values;
  for (const int bits : {8, 16, 32, 64})
    if (bits <= request.base.mask_bits && request.base.mask_bits > 8)
      values.push_back({std::to_string(bits), {{"mask_bits", std::to_string(bits)}}});
  return values;
}

struct Axis {
  AxisName name;
  Values (*values)(const SweepRequest&);
  std::string_view reference = "centre";
};
constexpr std::array kAxes{
    Axis{{"design", "design and mode"}, designs},
    Axis{{"exchange", "exchange"}, exchanges},
    Axis{{"primary", "who finds what is seen"}, visibilities},
    Axis{{"reflection-format", "reflection, format"},
         [](const SweepRequest&) { return choices_of("reflection"); }},
    Axis{{"precision", "precision of what travels"}, precisions},
    Axis{{"reflection-scale", "reflection, resolution"},
         [](const SweepRequest&) { return scales("reflection_scale"); }},
    Axis{{"mask-scale", "shadow mask, resolution"}, [](const SweepRequest&) { return scales("mask_scale"); }},
    Axis{{"mask-bits", "shadow mask, bits"}, mask_widths},
    Axis{{"tiles", "tiles that are sent"}, tiles},
    Axis{{"depth", "most bounces"}, depths},
    Axis{{"cutoff", "contribution cut-off"}, cutoffs},
    Axis{{"tree", "tree builder"}, [](const SweepRequest&) { return choices_of("tree"); }},
    Axis{{"triangle-test", "triangle test"}, [](const SweepRequest&) { return choices_of("triangle_test"); }},
    Axis{{"offset", "ray offset"}, [](const SweepRequest&) { return choices_of("offset"); }},
    Axis{{"simd", "SIMD width"}, [](const SweepRequest&) { return choices_of("isa"); }},
    Axis{{"threads", "threads"}, thread_counts},
    Axis{{"spp", "samples a pixel"}, sample_counts, "area"},
    Axis{{"sky", "light of a sky"}, skies, "area"},
    Axis{{"glass-shadows", "shadows of glass"}, glass},
    Axis{{"combined", "combinations"}, combinations},
};

// Whether the option changes the default's picture.
bool matters(const Option& option, const Settings& base) {
  const std::string_view field = option.first;
  if (field.starts_with("mask") || field == "light_cutoff") return base.mask_bits > 0;
  if (field.starts_with("reflection") || field == "throughput_cutoff" || field == "tiles" || field == "depth")
    return base.reflects();
  return base.traces() || (field != "visibility" && field != "exchange");
}

Settings settings_of(const Options& options) {
  Settings settings;
  for (const auto& [name, value] : options)
    if (!apply_preset(name, value, settings)) (void)set(settings, name, value);
  return settings;
}

// As options of the command line.
std::string text_of(const Options& options) {
  std::string text;
  for (const auto& [name, value] : options) {
    const Field* const field = find_field(name);
    std::string option = field ? field->option() : "--" + std::string(name);
    if (!field || field->kind != Field::Kind::flag) {
      option += " " + value;
    } else if (value == "false") {
      option.insert(2, "no-");
    }
    text += (text.empty() ? "" : " ") + option;
  }
  return text;
}

bool is_wanted(const SweepRequest& request, std::string_view axis) {
  return request.only.empty() ||
         std::find(request.only.begin(), request.only.end(), axis) != request.only.end();
}

}  // namespace

std::string Configuration::name() const {
  std::string name = axis + "-" + value;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '-';
  return name;
}

std::vector<Configuration> make_sweep(const SweepRequest& request) {
  std::vector<Configuration> sweep;
  for (const Axis& axis : kAxes) {
    if (!is_wanted(request, axis.name.name)) continue;
    Values values = axis.values(request);
    for (Value& value : values)
      std::erase_if(value.options, [&](const Option& o) { return !matters(o, request.base); });
    if (std::ranges::all_of(values, [](const Value& v) { return v.options.empty(); })) continue;
    for (const Value& value : values) {
      if (request.quick && !value.quick) continue;
      const Expected<Settings> settings = request.resolve(settings_of(value.options));
      if (!settings) continue;
      const std::string options = *settings == request.base ? "" : text_of(value.options);
      sweep.push_back(
          {std::string(axis.name.name), value.name, options, *settings, std::string(axis.reference)});
    }
  }
  return sweep;
}

std::vector<AxisName> axis_names() {
  std::vector<AxisName> names;
  for (const Axis& axis : kAxes) names.push_back(axis.name);
  return names;
}

}  // namespace pinocchio::chart
