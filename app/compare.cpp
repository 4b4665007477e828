// compare: how far one EXR is from another, in figures, a picture and an exit code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "app/error_limit.h"
#include "app/errors.h"
#include "app/parse.h"
#include "app/verbs.h"
#include "core/compare/comparison.h"
#include "core/compare/magma.h"
#include "core/image/atomic_file.h"
#include "core/image/png.h"

namespace pinocchio::app {
namespace {

constexpr std::array<std::string_view, 6> kMetrics{"rmse", "relmse", "psnr", "max", "flip", "mask"};

struct Options {
  std::string a, b;
  CompareOptions compare;
  std::string heatmap;
  std::vector<ErrorLimit> limits;
  bool json = false;
};

// CLI::Range lets NaN through.
std::string is_ppd(const std::string& text) {
  const std::optional<float> value = parse_float(text);
  if (value && *value >= kLeastPixelsPerDegree && *value <= kMostPixelsPerDegree) return "";
  return "'" + text + "' is no number of pixels per degree from 1 to 1000";
}

std::optional<double> figure(const Comparison& result, const std::string_view metric) {
  if (metric == "rmse") return result.rgb.rmse;
  if (metric == "relmse") return result.rgb.relative_mse;
  if (metric == "psnr") return result.rgb.psnr_db;
  if (metric == "max") return result.rgb.max_difference;
  if (metric == "flip") return result.mean_flip;
  if (result.mask) return result.mask->share();
  return std::nullopt;
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

// What a person reads beside a figure.
std::string remark(const Comparison& result, const Options& options, const std::string_view metric) {
  if (metric == "relmse") return "mean of (a - b)^2 / (b^2 + 0.01)";
  if (metric == "psnr") return "dB, peak 1, of the values clamped to [0, 1]";
  if (metric == "flip")
    return "mean LDR-FLIP, clamped to [0, 1] and sRGB, " +
           number(static_cast<double>(options.compare.pixels_per_degree)) + " pixels per degree";
  if (metric != "mask") return "";
  if (!result.mask) return "not compared: " + result.no_mask;
  return "share of shadow.mask bits that differ: " + std::to_string(result.mask->differing) + " of " +
         std::to_string(result.mask->bits);
}

void print(const Comparison& result, const Options& options) {
  std::printf("%s against %s\n", options.a.c_str(), options.b.c_str());
  for (const std::string_view metric : kMetrics) {
    const std::optional<double> value = figure(result, metric);
    const std::string said = remark(result, options, metric);
    std::printf("  %-7s %s\n", metric.data(),
                ((value ? number(*value) : "-") + (said.empty() ? "" : "  " + said)).c_str());
  }
  for (const auto& [name, c] : result.channels) {
    std::printf("  %s: %llu of %llu pixels differ", name.c_str(),
                static_cast<unsigned long long>(c.differing), static_cast<unsigned long long>(c.pixels));
    if (!c.integers)
      std::printf(", rmse %.6g, relmse %.6g, max %.6g", c.errors.rmse, c.errors.relative_mse,
                  c.errors.max_difference);
    if (c.not_finite > 0)
      std::printf(", %llu of them NaN or infinite and left out",
                  static_cast<unsigned long long>(c.not_finite));
    std::printf("\n");
  }
  if (!options.heatmap.empty()) std::printf("%s\n", options.heatmap.c_str());
}

nlohmann::json channel_json(const ChannelFigures& c) {
  nlohmann::json json{{"pixels", c.pixels}, {"differing", c.differing}};
  if (c.integers) return json;
  json["not_finite"] = c.not_finite;
  json["rmse"] = c.errors.rmse;
  json["relmse"] = c.errors.relative_mse;
  json["max"] = c.errors.max_difference;
  return json;
}

void print_json(const Comparison& result, const Options& options) {
  nlohmann::json json{{"a", options.a},
                      {"b", options.b},
                      {"size", {result.flip.width(), result.flip.height()}},
                      {"pixels_per_degree", options.compare.pixels_per_degree},
                      {"mask_bits", nullptr},
                      {"channels", nlohmann::json::object()}};
  for (const std::string_view metric : kMetrics) {
    const std::optional<double> value = figure(result, metric);
    json[std::string(metric)] = value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json();
  }
  if (result.mask)
    json["mask_bits"] = {{"slots", result.mask->slots},
                         {"compared", result.mask->bits},
                         {"differing", result.mask->differing}};
  for (const auto& [name, figures] : result.channels) json["channels"][name] = channel_json(figures);
  // Names of files may be no UTF-8.
  std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

// "rmse 0.2 is above 0.1, ..."; empty where all limits are kept.
std::string broken_limits(const Comparison& result, const Options& options) {
  std::string broken;
  for (const ErrorLimit& limit : options.limits) {
    const std::optional<double> value = figure(result, limit.metric);
    if (!value) throw Exit(kFailed, "--max-error mask: " + result.no_mask);
    const bool more_is_better = limit.metric == "psnr";
    if (more_is_better ? *value >= limit.value : *value <= limit.value) continue;
    broken += (broken.empty() ? "" : ", ") + limit.metric + " " + number(*value) + " is " +
              (more_is_better ? "below " : "above ") + number(limit.value);
  }
  return broken;
}

int run(const Options& options) {
  if (!options.heatmap.empty()) check_writable(options.heatmap);
  const NamedExr a{options.a, value_or_exit(read_exr(options.a), kBadScene)};
  const NamedExr b{options.b, value_or_exit(read_exr(options.b), kBadScene)};
  Workers workers;
  const Comparison result = value_or_exit(compare(a, b, options.compare, workers), kFailed);
  if (!options.heatmap.empty()) write_png(options.heatmap, magma(result.flip));
  options.json ? print_json(result, options) : print(result, options);
  std::fflush(stdout);  // before the line on stderr
  const std::string broken = broken_limits(result, options);
  if (!broken.empty()) throw Exit(kAboveLimit, options.a + ": " + broken);
  return kDone;
}

}  // namespace

Run add_compare(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App& verb = *program.add_subcommand("compare", "how far one EXR is from another");
  verb.add_option("A", options->a, "EXR file")->required();
  verb.add_option("B", options->b, "EXR file of the same size: the reference")->required();
  verb.add_option("--ppd", options->compare.pixels_per_degree,
                  "FLIP: pixels per degree of visual angle (67: a 4K screen at arm's length)")
      ->check(CLI::Validator(is_ppd, "1 to 1000"));
  verb.add_option("--channel", options->compare.channels, "compare this channel too, e.g. Z; may be repeated")
      ->allow_extra_args(false);
  verb.add_flag("--channels", options->compare.all_channels, "compare every channel that both files have");
  verb.add_option("--heatmap", options->heatmap, "write FLIP's errors as a PNG, black to yellow");
  verb.add_option_function<std::vector<std::string>>(
          "--max-error",
          [options](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
              options->limits.push_back(parse_error_limit(text, kMetrics));
          },
          "METRIC=VALUE: exit code 5 above it (psnr: below); rmse, relmse, psnr, max, flip or mask (share of "
          "bits, 0 to 1); may be repeated")
      ->allow_extra_args(false);
  verb.add_flag("--json", options->json, "the figures as JSON; an infinite PSNR is null");
  return [options] { return run(*options); };
}

}  // namespace pinocchio::app
