// How a frame is drawn: one struct. Every field stands in one table (settings_table()), from which come the
// command line's options, the settings' JSON, the window's widgets, the chart's axes and docs/settings.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "pinocchio/error.h"
#include "pinocchio/terminator.h"
#include "pinocchio/tracer.h"
#include "pinocchio/view.h"

namespace pinocchio {

// Who does a part of the work.
enum class Processor { cpu, gpu };
inline constexpr std::array<std::string_view, 2> kProcessorNames{"cpu", "gpu"};

// When the GPU gets the CPU's part of a frame.
enum class Exchange {
  sync,       // at once: everybody waits
  pipelined,  // frames later: GPU and CPU work on different frames meanwhile
  reproject,  // never waited for: the newest raster at once, an older frame's mask and reflection warped to
              // it
};
inline constexpr std::array<std::string_view, 3> kExchangeNames{"sync", "pipelined", "reproject"};

// How mirrored and refracted light travels to the GPU.
enum class ReflectionFormat {
  none,
  rgb8,    // 3 bytes a pixel, sRGB, clipped at 1: the slides'
  rgb9e5,  // 4 bytes: 9 bits a colour, one exponent
  half,    // 6 bytes: exact to the picture's own format
  full,    // 12 bytes: float
};
inline constexpr std::array<std::string_view, 5> kReflectionFormatNames{"none", "rgb8", "rgb9e5", "half",
                                                                        "float"};
[[nodiscard]] int bytes_per_pixel(ReflectionFormat format);

// Where the samples of a pixel are of what is sampled: lights with a size, glossy mirrors, lenses.
enum class Sequence {
  sobol,       // scrambled Sobol points, each pixel its own: the error falls faster than by chance
  blue_noise,  // one sequence for all, turned from pixel to pixel: what error is left is fine-grained
  random,
};
inline constexpr std::array<std::string_view, 3> kSequenceNames{"sobol", "blue-noise", "random"};

inline constexpr std::array<std::string_view, 2> kPixelFilterNames{"box", "blackman-harris"};

inline constexpr int kMostBounces = 64, kMostThreads = 1024;

// A value, and whether the user set it: assigning to it says so. What nobody set, resolve() fills in.
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
  // Where nobody set it.
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
  Setting<Terminator> terminator = Setting<Terminator>::by_default(kUsualTerminator);
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
  // Whether anything is left for the CPU to do.
  [[nodiscard]] bool traces() const {
    return mask_bits > 0 || reflects() || visibility == Processor::cpu || composite == Processor::cpu;
  }

  // The same values, whoever set them.
  friend bool operator==(const Settings& a, const Settings& b);
};

// A field of Settings, for programs that read, write or show settings by name.
struct Field {
  enum class Kind { choice, whole, number, flag };

  std::string_view name;  // in JSON; on the command line with '-' for '_'
  Kind kind;
  std::span<const std::string_view> choices;  // all values there are; empty: from lo to hi, or a flag
  double lo, hi;
  std::string_view unset;  // what it is where nobody set it, in words
  std::string_view help;
  bool of_machine;            // of how it is computed: no pixel changes with it
  std::string_view formerly;  // its name in older files; empty: none

  std::string (*text)(const Settings&);            // the value as it is written
  bool (*take)(std::string_view text, Settings&);  // false, and nothing changed: no such value
  bool (*given)(const Settings&);
  void (*copy)(const Settings& from, Settings& to);  // value and whether it was set
  bool (*same)(const Settings&, const Settings&);    // of the values

  // What it may be, in words: "sync, pipelined or reproject", "a whole number from 0 to 64".
  [[nodiscard]] std::string domain() const;
  [[nodiscard]] std::string option() const;  // "--mask-bits"
};
[[nodiscard]] std::span<const Field> settings_table();
[[nodiscard]] const Field* find_field(std::string_view name);  // by name or former name; null: none

// Sets a field by its name. An error that names the domain where there is no such field or value.
[[nodiscard]] Expected<void> set(Settings& settings, std::string_view field, std::string_view text);

// Every field that `over` gives replaces the one of `settings`.
void override_with(const Settings& over, Settings& settings);

// Rows that set several fields at once, by the option and the value that name them.
struct Preset {
  std::string_view option, value;  // "mode", "raytrace"
  std::string_view help;
  void (*apply)(Settings&);
};
[[nodiscard]] std::span<const Preset> presets();
// "mode", "design" or "plan"; false: there is no such value.
bool apply_preset(std::string_view option, std::string_view value, Settings& settings);

// What no two fields may say at once, and why.
struct Rule {
  std::string_view what, remedy;
  bool (*broken)(const Settings&);
};
[[nodiscard]] std::span<const Rule> settings_rules();
// The first rule that the settings break; null: none.
[[nodiscard]] const Rule* broken_rule(const Settings& settings);
// The first rule that would break if the field had that value; null: it can be had.
[[nodiscard]] const Rule* broken_by(const Settings& settings, std::string_view field, std::string_view text);

// How a tracer's tree is built.
[[nodiscard]] BuildOptions build_options(const Settings& settings);
// Whether a tracer of the one's is the other's.
[[nodiscard]] bool same_tracer(const Settings& a, const Settings& b);

}  // namespace pinocchio
