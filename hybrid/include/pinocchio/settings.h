// The settings of a frame. Every field has a row in one table (settings_table()). The command line's options,
// the settings' JSON, the window's widgets, the chart's axes and docs/settings.md are made from it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "pinocchio/backfaces.h"
#include "pinocchio/background.h"
#include "pinocchio/error.h"
#include "pinocchio/glass_shadows.h"
#include "pinocchio/sampled_light.h"
#include "pinocchio/shadow_catcher.h"
#include "pinocchio/terminator.h"
#include "pinocchio/tracer.h"
#include "pinocchio/view.h"

namespace pinocchio {

// The processor that does a part of the work.
enum class Processor { cpu, gpu };
inline constexpr std::array<std::string_view, 2> kProcessorNames{"cpu", "gpu"};

// The time at which the GPU gets the CPU's part of a frame.
enum class Exchange {
  sync,       // at once: GPU and CPU wait for each other
  pipelined,  // frames later: GPU and CPU work on different frames
  reproject,  // never waited for: the newest raster is shown at once, with an older frame's mask and
              // reflection warped to it
};
inline constexpr std::array<std::string_view, 3> kExchangeNames{"sync", "pipelined", "reproject"};

// The format of mirrored and refracted light on its way to the GPU.
enum class ReflectionFormat {
  none,
  rgb8,    // 3 bytes a pixel, sRGB, clipped at 1: the slides' format
  rgb9e5,  // 4 bytes: 9 bits a colour, one exponent
  half,    // 6 bytes: as exact as the picture's format
  full,    // 12 bytes: float
};
inline constexpr std::array<std::string_view, 5> kReflectionFormatNames{"none", "rgb8", "rgb9e5", "half",
                                                                        "float"};
[[nodiscard]] int bytes_per_pixel(ReflectionFormat format);

// The sequence of a pixel's samples of lights with a size, glossy mirrors and lenses.
enum class Sequence {
  sobol,       // scrambled Sobol points, different for each pixel: the error falls faster than at random
  blue_noise,  // one sequence, shifted from pixel to pixel: the remaining error is fine-grained
  random,
  z_order,  // one sequence through the picture: neighbours' samples are evenly spread together, for the
            // filter
};
inline constexpr std::array<std::string_view, 4> kSequenceNames{"sobol", "blue-noise", "random", "z-order"};

inline constexpr std::array<std::string_view, 2> kPixelFilterNames{"box", "blackman-harris"};

inline constexpr int kMostBounces = 64, kMostThreads = 1024, kMostMaskBits = 64;

// A value, and whether the user set it by an assignment. resolve() chooses values that are not set.
template <class T>
struct Setting {
  T value{};
  bool given = false;

  Setting() = default;
  Setting(T v) : value(v), given(true) {}
  [[nodiscard]] static Setting by_default(T v) {
    Setting setting(v);
    setting.given = false;
    return setting;
  }
  operator T() const { return value; }
  // Sets the value unless the user did.
  void fill(T v) {
    if (!given) value = v;
  }
};

// Each field's meaning, domain and default: settings_table(), `pinocchio info --settings`, docs/settings.md.
struct Settings {
  Setting<Processor> visibility = Setting<Processor>::by_default(Processor::gpu);
  Setting<Processor> composite = Setting<Processor>::by_default(Processor::gpu);
  Setting<bool> by_machine;
  Setting<Exchange> exchange;
  Setting<int> spp = Setting<int>::by_default(1);
  Setting<float> max_noise;
  Setting<PixelFilter> pixel_filter;
  Setting<Sequence> sequence;
  Setting<int> seed;
  Setting<int> depth = Setting<int>::by_default(8);
  Setting<int> mask_bits = Setting<int>::by_default(8);
  Setting<int> mask_scale = Setting<int>::by_default(1);
  Setting<ReflectionFormat> reflection = Setting<ReflectionFormat>::by_default(ReflectionFormat::half);
  Setting<int> reflection_scale = Setting<int>::by_default(1);
  Setting<bool> tiles;
  Setting<int> id_bits = Setting<int>::by_default(32);
  Setting<bool> normals, wide;
  Setting<float> throughput_cutoff = Setting<float>::by_default(kThroughputCutoff);
  Setting<float> light_cutoff;
  Setting<int> indirect;
  Setting<float> environment_rotation, environment_strength = Setting<float>::by_default(1.0f);
  Setting<EnvironmentMethod> environment_light;
  Setting<Glossy> glossy;
  Setting<int> sky_occlusion;
  Setting<float> sky_bounce;
  Setting<GlassShadows> glass_shadows = Setting<GlassShadows>::by_default(kUsualGlassShadows);
  Setting<bool> denoise, average_layers;
  Setting<Background> background;
  Setting<float> background_blur;
  Setting<ShadowCatcher> shadow_catcher;
  Setting<Terminator> terminator = Setting<Terminator>::by_default(kUsualTerminator);
  Setting<Backfaces> backfaces = Setting<Backfaces>::by_default(Backfaces::automatic);
  Setting<bool> coverage;
  Setting<bool> filter_textures = Setting<bool>::by_default(true);
  Setting<bool> reuse = Setting<bool>::by_default(true);
  Setting<bool> persistent;
  Setting<int> threads;
  Setting<Isa> isa = Setting<Isa>::by_default(default_isa());
  Setting<SplitRule> tree;
  Setting<int> tree_depth;
  Setting<int> tree_leaf = Setting<int>::by_default(BuildOptions{}.leaf_size);
  Setting<TriangleTest> triangle_test = Setting<TriangleTest>::by_default(BuildOptions{}.triangle_test);
  Setting<OffsetMethod> offset = Setting<OffsetMethod>::by_default(OffsetMethod::error_bound);

  [[nodiscard]] bool reflects() const { return reflection != ReflectionFormat::none; }
  [[nodiscard]] bool uses_gpu() const { return visibility == Processor::gpu || composite == Processor::gpu; }
  // Whether the CPU has any work.
  [[nodiscard]] bool traces() const {
    return mask_bits > 0 || reflects() || visibility == Processor::cpu || composite == Processor::cpu;
  }

  // Whether the values are the same, whoever set them.
  friend bool operator==(const Settings& a, const Settings& b);
};

// A field of Settings, for code that reads, writes or shows settings by name.
struct Field {
  enum class Kind { choice, whole, number, flag, text };
  enum class Group { samples, light, rays, exchange, tree, machine };  // help and window list them so

  Group group;
  std::string_view name;  // as in JSON; on the command line with '-' instead of '_'
  Kind kind;
  std::span<const std::string_view> choices;  // all values; empty: numbers from lo to hi, a flag or a text
  double lo, hi;
  std::string_view words;                      // of a text: the allowed values in words ...
  std::span<const std::string_view> examples;  // ... and some of them
  std::string_view alone;  // the value that the option has on the command line without one; empty: none
  std::string_view unset;  // the value if it is not set, in words
  std::string_view help;
  bool of_machine;            // changes only how a picture is computed, and no pixel
  std::string_view formerly;  // its name in older files; empty: none

  std::string (*text)(const Settings&);            // the value as text
  bool (*take)(std::string_view text, Settings&);  // false: there is no such value, and nothing changes
  bool (*given)(const Settings&);
  void (*copy)(const Settings& from, Settings& to);  // the value, and whether it was set
  bool (*same)(const Settings&, const Settings&);    // compares the values

  // The allowed values in words: "sync, pipelined or reproject", "a whole number from 0 to 64".
  [[nodiscard]] std::string domain() const;
  [[nodiscard]] std::string option() const;  // "--mask-bits"
};
[[nodiscard]] std::span<const Field> settings_table();
[[nodiscard]] const Field* find_field(std::string_view name);  // by name or former name; null: none

// Sets a field by its name. If there is no such field or value, the error names the allowed ones.
[[nodiscard]] Expected<void> set(Settings& settings, std::string_view field, std::string_view text);

// Each field that is set in `over` replaces the one in `settings`.
void override_with(const Settings& over, Settings& settings);

// A preset: an option with a value that sets several fields at once.
struct Preset {
  std::string_view option, value;  // "mode", "raytrace"
  std::string_view help;
  void (*apply)(Settings&);
};
[[nodiscard]] std::span<const Preset> presets();
// option: "mode", "design" or "plan". False: there is no such value.
bool apply_preset(std::string_view option, std::string_view value, Settings& settings);

// Lets the CPU draw alone, whatever is set: for views that OpenGL cannot draw (View::is_rasterisable).
void draw_on_cpu(Settings& settings);

// Whether the other settings let light be filtered.
[[nodiscard]] bool can_denoise(const Settings& settings);

// A combination of fields that is not allowed, and the reason.
struct Rule {
  std::string_view what, remedy;
  bool (*broken)(const Settings&);
};
[[nodiscard]] std::span<const Rule> settings_rules();
// The first rule that the settings break; null: none.
[[nodiscard]] const Rule* broken_rule(const Settings& settings);
// The first rule that the settings would break with that value of the field; null: none.
[[nodiscard]] const Rule* broken_by(const Settings& settings, std::string_view field, std::string_view text);

// The options for building a tracer's tree.
[[nodiscard]] BuildOptions build_options(const Settings& settings);
// Whether a tracer for one can be used for the other.
[[nodiscard]] bool same_tracer(const Settings& a, const Settings& b);

}  // namespace pinocchio
