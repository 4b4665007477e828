// The one table of settings.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/decimal.h"
#include "core/base/listed.h"
#include "pinocchio/conversion.h"
#include "pinocchio/settings.h"

namespace pinocchio {
namespace {

template <class T>
struct Member;
template <class T>
struct Member<Setting<T> Settings::*> {
  using Value = T;
};

template <class T>
std::optional<T> number_of(std::string_view text, double lo, double hi) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  const auto wide = as_double(value);
  return wide >= lo && wide <= hi ? std::optional(value) : std::nullopt;
}

constexpr std::array<std::string_view, 3> kScales{"1", "2", "4"};
constexpr std::array<std::string_view, 8> kMaskBits{"0", "1", "2", "4", "8", "16", "32", "64"};
constexpr std::array<std::string_view, 3> kIdBits{"16", "24", "32"};
constexpr std::array<std::string_view, 2> kFlag{"false", "true"};

constexpr std::array<std::string_view, 5> kBackgrounds{"environment", "studio", "transparent", "white",
                                                       "0.18,0.18,0.18"};
constexpr std::array<std::string_view, 3> kCatchers{"off", "lowest", "0"};

// The values that a field may have.
struct Domain {
  std::span<const std::string_view> choices{};
  double lo = 0.0, hi = 0.0;
  std::string_view words{};
  std::span<const std::string_view> examples{};
  std::string_view alone{};
};
constexpr Domain one_of(std::span<const std::string_view> choices) {
  return {.choices = choices};
}
constexpr Domain from_to(double lo, double hi) {
  return {.lo = lo, .hi = hi};
}
constexpr Domain yes_or_no() {
  return one_of(kFlag);
}

constexpr Domain text(std::string_view words, std::span<const std::string_view> examples,
                      std::string_view alone = {}) {
  return {.words = words, .examples = examples, .alone = alone};
}

template <class T>
concept IsText = requires(const T& value) {
  to_text(value);
};
std::optional<Background> parsed(std::string_view text, const Background&) {
  return parse_background(text);
}
std::optional<ShadowCatcher> parsed(std::string_view text, const ShadowCatcher&) {
  return parse_shadow_catcher(text);
}

// Reads and writes one field.
template <auto M>
struct Access {
  using T = typename Member<decltype(M)>::Value;

  static std::string text(const Settings& s) {
    const T value = s.*M;
    if constexpr (std::is_same_v<T, bool>) {
      return value ? "true" : "false";
    } else if constexpr (IsText<T>) {
      return to_text(value);
    } else if constexpr (std::is_enum_v<T>) {
      return std::string(row().choices[as_size(value)]);
    } else {
      return shortest(value);
    }
  }
  static bool take(std::string_view text, Settings& s) {
    const Field& field = row();
    const auto chosen = std::ranges::find(field.choices, text);
    if (!field.choices.empty() && chosen == field.choices.end()) return false;
    const auto index = chosen - field.choices.begin();
    if constexpr (std::is_same_v<T, bool>) {
      s.*M = index == 1;
    } else if constexpr (IsText<T>) {
      const std::optional<T> value = parsed(text, T{});
      if (!value) return false;
      s.*M = *value;
    } else if constexpr (std::is_enum_v<T>) {
      s.*M = static_cast<T>(index);
    } else {
      const bool listed = !field.choices.empty();
      const std::optional<T> value =
          number_of<T>(text, listed ? -HUGE_VAL : field.lo, listed ? HUGE_VAL : field.hi);
      if (!value) return false;
      s.*M = *value;
    }
    return true;
  }
  static bool given(const Settings& s) { return (s.*M).given; }
  static void copy(const Settings& from, Settings& to) { to.*M = from.*M; }
  static bool same(const Settings& a, const Settings& b) { return (a.*M).value == (b.*M).value; }
  static const Field& row();
};

template <auto M>
constexpr Field field(Field::Group group, std::string_view name, Domain domain, std::string_view unset,
                      std::string_view help, bool of_machine = false, std::string_view formerly = {}) {
  using T = typename Access<M>::T;
  const auto kind = IsText<T>                  ? Field::Kind::text
                    : std::is_same_v<T, bool>  ? Field::Kind::flag
                    : std::is_enum_v<T>        ? Field::Kind::choice
                    : std::is_same_v<T, float> ? Field::Kind::number
                                               : Field::Kind::whole;
  using A = Access<M>;
  return {.group = group,
          .name = name,
          .kind = kind,
          .choices = domain.choices,
          .lo = domain.lo,
          .hi = domain.hi,
          .words = domain.words,
          .examples = domain.examples,
          .alone = domain.alone,
          .unset = unset,
          .help = help,
          .of_machine = of_machine,
          .formerly = formerly,
          .text = &A::text,
          .take = &A::take,
          .given = &A::given,
          .copy = &A::copy,
          .same = &A::same};
}

using S = Settings;
using G = Field::Group;
constexpr bool kOfMachine = true;
constexpr std::array kTable{
    field<&S::visibility>(G::exchange, "visibility", one_of(kProcessorNames),
                          "gpu; cpu where a software rasteriser would take longer than the rays",
                          "the processor that finds each pixel's visible triangle"),
    field<&S::composite>(G::exchange, "composite", one_of(kProcessorNames), "gpu",
                         "the processor that composites the picture"),
    field<&S::by_machine>(
        G::exchange, "by_machine", yes_or_no(), "false",
        "choose visibility and composite, where they are not given: the GPU where OpenGL is "
        "hardware, else the CPU, and no OpenGL is opened",
        kOfMachine),
    field<&S::exchange>(G::exchange, "exchange", one_of(kExchangeNames),
                        "pipelined over several frames, sync for one",
                        "sync: wait for the CPU; pipelined: its part comes frames later, GPU and CPU work on "
                        "different frames; reproject: newest raster, the last mask and reflection warped to "
                        "it, only for pictures of one sample"),
    field<&S::spp>(G::samples, "spp", from_to(1, 65536), "1",
                   "jittered samples a pixel, averaged in linear light"),
    field<&S::max_noise>(
        G::samples, "max_noise", from_to(0, 1), "0",
        "a tile of 32x32 pixels takes no more samples once the standard error of its pixels' "
        "means, linear, is below this; 0: every pixel takes all samples"),
    field<&S::pixel_filter>(
        G::samples, "pixel_filter", one_of(kPixelFilterNames), "box",
        "how a pixel's samples are spread: box, evenly over the pixel; blackman-harris, over "
        "3 pixels by that window, which smooths edges"),
    field<&S::sequence>(G::samples, "sequence", one_of(kSequenceNames), "sobol; z-order with denoise",
                        "sequence of a pixel's samples: sobol, scrambled points of its own; blue-noise, one "
                        "Sobol sequence rotated from pixel to pixel, so that noise is fine-grained; random, "
                        "random numbers; z-order, one Sobol sequence through all pixels, so that "
                        "neighbours' samples complement each other"),
    field<&S::seed>(G::samples, "seed", from_to(0, 65535), "0", "another seed gives other samples"),
    field<&S::depth>(G::rays, "depth", from_to(0, kMostBounces),
                     "8, or fewer where the scene's mirrors need no more", "most bounces"),
    field<&S::mask_bits>(G::exchange, "mask_bits", one_of(kMaskBits),
                         "the fewest that hold the casting lights, at most 64",
                         "bits a pixel of the shadow mask that goes to the GPU, one a light; from 8 on, the "
                         "light of casting lights beyond them travels with mirrored light; 0: no shadows"),
    field<&S::mask_scale>(G::exchange, "mask_scale", one_of(kScales), "1",
                          "pixels a side that share a sample of the shadow mask"),
    field<&S::reflection>(G::exchange, "reflection", one_of(kReflectionFormatNames),
                          "half where something mirrors",
                          "how mirrored and refracted light travels to the GPU; none: it is not traced"),
    field<&S::reflection_scale>(G::exchange, "reflection_scale", one_of(kScales), "1",
                                "pixels a side that share a sample of mirrored light"),
    field<&S::tiles>(G::exchange, "tiles", yes_or_no(), "true where mirrored light travels",
                     "send only the tiles of 8x8 pixels that have mirrored light"),
    field<&S::id_bits>(G::exchange, "id_bits", one_of(kIdBits),
                       "the fewest of 16 and 32 that name every triangle",
                       "bits of a triangle's id in transfers"),
    field<&S::normals>(G::exchange, "normals", yes_or_no(), "false",
                       "send shading normals to the CPU as well, 3 bytes a pixel, as in 2005"),
    field<&S::wide>(G::exchange, "wide", yes_or_no(), "false",
                    "send the 128 bits a pixel of 2005 to the CPU instead of ids alone"),
    field<&S::throughput_cutoff>(
        G::rays, "throughput_cutoff", from_to(0, 1), "0.00012207031",
        "mirrored rays that would add less linear light than this to their pixel are not traced; 0: all "
        "are",
        false, "least_contribution"),
    field<&S::light_cutoff>(
        G::rays, "light_cutoff", from_to(0, 1),
        "0 where the mask itself is kept, else half a step of an 8-bit picture",
        "shadow rays that would add less linear light than this to a visible point without textures are "
        "not traced; 0: all are",
        false, "least_light"),
    field<&S::coverage>(G::rays, "coverage", yes_or_no(), "false",
                        "surfaces that blend have their own alpha, not 1; the CPU draws alone"),
    field<&S::filter_textures>(G::rays, "filter_textures", yes_or_no(), "true",
                               "average textures over the area that a pixel or its mirror image covers"),
    field<&S::indirect>(G::light, "indirect", from_to(0, kMostBounces), "0",
                        "most bounces of light from one matt surface to the next, by samples; above 0 there "
                        "is no ambient light (docs/environment.md)"),
    field<&S::environment_rotation>(G::light, "environment_rotation", from_to(-360, 360), "0",
                                    "rotation of the environment about the upward axis, degrees"),
    field<&S::environment_strength>(G::light, "environment_strength", from_to(0, 1e6), "1",
                                    "factor of the environment's light; 0: no environment"),
    field<&S::environment_light>(G::light, "environment_light", one_of(kEnvironmentMethodNames),
                                 "sampled; prefiltered for the studio",
                                 "how the environment lights surfaces: sampled, exact with many samples; "
                                 "prefiltered, by means, without noise and, unless sky_occlusion is "
                                 "above 0, without shadows of the sky (docs/environment.md)"),
    field<&S::glossy>(
        G::light, "glossy", one_of(kGlossyNames), "sampled; sharp where the environment is prefiltered",
        "what rough surfaces mirror: sampled, all that their lobes see; sharp, an image that fades "
        "out with roughness, without noise"),
    field<&S::sky_occlusion>(
        G::light, "sky_occlusion", from_to(0, 64), "0; 8 for the studio",
        "shadow rays at each point that hide a prefiltered environment, about the surface's "
        "normal; 0: it casts no shadows"),
    field<&S::sky_bounce>(
        G::light, "sky_bounce", from_to(0, 1), "0; 0.5 for the studio without indirect",
        "share of the prefiltered environment's hidden light that is kept, times the point's albedo: an "
        "estimate of the light from what hides it; no effect where sky_occlusion is 0 or with indirect"),
    field<&S::glass_shadows>(
        G::light, "glass_shadows", one_of(kGlassShadowsNames), glass_shadows_name(kUsualGlassShadows),
        "shadow rays at glass: opaque: they end, and glass casts a full shadow; tinted: they continue "
        "straight, dimmed by Fresnel's reflection, the glass's colour and its absorption "
        "(docs/glass.md)"),
    field<&S::denoise>(
        G::samples, "denoise", yes_or_no(), "false; true in the window",
        "filter the light that samples find (environment, lights with a size, rough mirrors, "
        "other surfaces), for few samples; hard light, sharp mirrors and textures stay as they are "
        "(docs/denoise.md)"),
    field<&S::average_layers>(G::samples, "average_layers", yes_or_no(), "false",
                              "the layers N and Albedo are means over the samples, as denoisers want them, "
                              "not of the first sample"),
    field<&S::background>(
        G::light, "background", text(kBackgroundTexts, kBackgrounds),
        "environment; studio where the studio lights",
        "what is behind the scene; light, mirrors and glass keep the environment. Transparent: alpha 0, "
        "also in PNG files"),
    field<&S::background_blur>(
        G::light, "background_blur", from_to(0, 1), "0",
        "how far the environment or studio behind the scene is blurred; 1: by 30 degrees (standard "
        "deviation). Light, mirrors and glass keep it sharp"),
    field<&S::shadow_catcher>(
        G::light, "shadow_catcher", text(kShadowCatcherTexts, kCatchers, "lowest"),
        "off; lowest for the studio",
        "a ground, at a height or at the scene's lowest point, that shows only the shadows on it: its alpha "
        "is the share of light that they take"),
    field<&S::terminator>(
        G::rays, "terminator", one_of(kTerminatorNames), terminator_name(kUsualTerminator),
        "where a coarse mesh's shading normals face a light and its facets do not: off: dark; "
        "smoothed: light falls to zero there; displaced: shadow rays start on the curved "
        "surface; turned-away: the same, on facets that turn away only (docs/terminator.md)"),
    field<&S::backfaces>(
        G::rays, "backfaces", one_of(kBackfacesNames), "auto",
        "which backs the camera does not see: auto: those that their file marks as single-sided, as glTF "
        "does; draw: none; cull: all that their file does not mark as double-sided. Shadows, mirrors and "
        "glass see both sides"),
    field<&S::reuse>(G::exchange, "reuse", yes_or_no(), "true",
                     "do not draw a frame again whose request equals the last one's"),
    field<&S::persistent>(G::exchange, "persistent", yes_or_no(), "false", "keep transfer buffers mapped",
                          kOfMachine),
    field<&S::threads>(G::machine, "threads", from_to(0, kMostThreads), "0", "worker threads; 0: one a core",
                       kOfMachine),
    field<&S::isa>(G::machine, "isa", one_of(kIsaNames), "the widest that the processor has", "SIMD level",
                   kOfMachine),
    field<&S::tree>(G::tree, "tree", one_of(kSplitRuleNames), "sah", "how the BSP tree is split"),
    field<&S::tree_depth>(G::tree, "tree_depth", from_to(0, kMaxTreeDepth), "0",
                          "most levels of the BSP tree; 0: from the number of triangles"),
    field<&S::tree_leaf>(G::tree, "tree_leaf", from_to(1, 1 << 20), "2",
                         "triangles that are not split further"),
    field<&S::triangle_test>(G::tree, "triangle_test", one_of(kTriangleTestNames), "filtered",
                             "how a ray meets a triangle (docs/stability.md)"),
    field<&S::offset>(G::tree, "offset", one_of(kOffsetMethodNames), "error-bound",
                      "distance from a surface at which its shadow and mirrored rays start: one length, one "
                      "length a scene, or a bound of the rounding error there"),
};

template <auto M>
const Field& Access<M>::row() {
  return *std::ranges::find_if(kTable, [](const Field& f) { return f.copy == &Access<M>::copy; });
}

}  // namespace

std::string Field::domain() const {
  if (kind == Kind::text) return std::string(words);
  if (!choices.empty()) return listed(choices, ", ", " or ");
  return (kind == Kind::whole ? "a whole number from " : "a number from ") + shortest(lo) + " to " +
         shortest(hi);
}

std::string Field::option() const {
  std::string dashed = "--" + std::string(name);
  std::ranges::replace(dashed, '_', '-');
  return dashed;
}

std::span<const Field> settings_table() {
  return kTable;
}

const Field* find_field(std::string_view name) {
  const auto* const found = std::ranges::find_if(
      kTable, [&](const Field& f) { return f.name == name || (!f.formerly.empty() && f.formerly == name); });
  return found == kTable.end() ? nullptr : found;
}

Expected<void> set(Settings& settings, std::string_view field, std::string_view text) {
  const Field* const found = find_field(field);
  if (!found)
    return Unexpected(InputError{
        {}, 0, "there is no setting '" + std::string(field) + "'", "'pinocchio info --settings' lists them"});
  if (!found->take(text, settings))
    return Unexpected(
        InputError{{}, 0, std::string(found->name) + " is " + std::string(text), "it is " + found->domain()});
  return {};
}

void override_with(const Settings& over, Settings& settings) {
  for (const Field& f : kTable)
    if (f.given(over)) f.copy(over, settings);
}

bool operator==(const Settings& a, const Settings& b) {
  return std::ranges::all_of(kTable, [&](const Field& f) { return f.same(a, b); });
}

BuildOptions build_options(const Settings& settings) {
  BuildOptions options;
  options.rule = settings.tree;
  options.max_depth = settings.tree_depth;
  options.leaf_size = settings.tree_leaf;
  options.threads = settings.threads;
  options.triangle_test = settings.triangle_test;
  return options;
}

bool same_tracer(const Settings& a, const Settings& b) {
  return std::ranges::all_of(
      kTable, [&](const Field& f) { return (f.group != G::tree && f.name != "isa") || f.same(a, b); });
}

}  // namespace pinocchio
