// compare: how much pictures differ, in figures, heat maps and an exit code.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/cli/add_option.h"
#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/named_files.h"
#include "app/cli/parse.h"
#include "app/report/compare_report.h"
#include "app/run/output.h"
#include "app/verbs/verbs.h"
#include "core/base/decimal.h"
#include "core/compare/magma.h"
#include "core/files/atomic_file.h"
#include "core/image/codecs/formats.h"
#include "core/image/codecs/png.h"

namespace pinocchio::app {
namespace {

struct Options {
  std::string a, b;
  CompareOptions compare;
  std::string heatmap, junit;
  std::vector<ErrorLimit> limits;
  bool json = false;
};

// The failure is "rmse 0.2 is above 0.1, ...". A limit of a metric that this pair has no figure of is an
// error.
void apply_limits(const std::vector<ErrorLimit>& limits, PairResult& result) {
  std::string broken;
  for (const ErrorLimit& limit : limits) {
    const std::optional<double> value = figure(*result.figures, limit.metric);
    if (!value) {
      result.failure = "--max-error mask: " + result.figures->no_mask;
      result.code = kFailed;
      return;
    }
    const bool higher_is_better = limit.metric == "psnr";
    if (higher_is_better ? *value >= limit.value : *value <= limit.value) continue;
    broken += (broken.empty() ? "" : ", ") + limit.metric + " " + decimal(*value) + " is " +
              (higher_is_better ? "below " : "above ") + decimal(limit.value);
  }
  if (broken.empty()) return;
  result.failure = result.pair.a.string() + ": " + broken;
  result.code = kAboveLimit;
}

PairResult failed(const PicturePair& pair, const std::string& why, ExitCode code) {
  PairResult result;
  result.pair = pair;
  result.failure = why;
  result.code = code;
  return result;
}

PairResult compare_pair(const PicturePair& pair, const Options& options, const std::string& heatmap,
                        Workers& workers) {
  if (pair.a.empty())
    return failed(pair, pair.b.string() + ": has no counterpart in " + options.a, kAboveLimit);
  if (pair.b.empty())
    return failed(pair, pair.a.string() + ": has no counterpart in " + options.b, kAboveLimit);
  Expected<ExrFile> a = read_picture(pair.a), b = read_picture(pair.b);
  if (!a) return failed(pair, a.error().message(), kBadScene);
  if (!b) return failed(pair, b.error().message(), kBadScene);
  Expected<Comparison> compared = compare({pair.a.string(), std::move(*a)}, {pair.b.string(), std::move(*b)},
                                          options.compare, workers, &run_progress());
  if (!compared) return failed(pair, compared.error().message(), kFailed);
  PairResult result;
  result.pair = pair;
  result.size = compared->flip.size();
  if (!heatmap.empty()) {
    if (const std::filesystem::path folder = std::filesystem::path(heatmap).parent_path();
        !folder.empty() && options.heatmap != heatmap)
      make_folder(folder, "--heatmap");
    write_png(heatmap, magma(compared->flip));
    result.heatmap = heatmap;
  }
  compared->flip = {};
  result.figures = std::move(*compared);
  apply_limits(options.limits, result);
  return result;
}

// Whether folders or sequences are compared.
bool has_several(const Options& options, const PicturePair& pair) {
  return pair.a != options.a && pair.b != options.b;
}

// --heatmap itself for two pictures, else NAME.png in that folder.
std::string heatmap_of(const Options& options, const PicturePair& pair) {
  if (options.heatmap.empty() || !has_several(options, pair)) return options.heatmap;
  return (std::filesystem::path(options.heatmap) / (pair.name + ".png")).string();
}

// Follows links and relative names. The path need not exist.
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path inner = std::filesystem::weakly_canonical(path, error),
                              outer = std::filesystem::canonical(folder, error);
  if (error || !std::filesystem::is_directory(outer, error)) return false;
  return std::ranges::mismatch(outer, inner).in1 == outer.end();
}

void check_files(const Options& options, const std::vector<PicturePair>& pairs) {
  std::vector<NamedFile> inputs, outputs{{"--junit", options.junit}};
  for (const PicturePair& pair : pairs) {
    inputs.push_back({"A", pair.a});
    inputs.push_back({"B", pair.b});
    outputs.push_back({"--heatmap", heatmap_of(options, pair)});
  }
  check_apart(inputs, outputs);
  const bool several = has_several(options, pairs.front());
  // The next comparison would take heat maps there for pictures.
  for (const std::string& compared : {options.a, options.b})
    if (several && is_within(options.heatmap, compared))
      throw Exit(kUsage, "--heatmap " + options.heatmap + ": within " + compared +
                             ", whose pictures are compared; choose another folder");
  if (several && !options.heatmap.empty()) make_folder(options.heatmap, "--heatmap");
  if (!several && !options.heatmap.empty()) {
    if (const std::string error = ending_error(options.heatmap, ".png"); !error.empty())
      throw Exit(kUsage, "--heatmap: " + error);
    check_writable(options.heatmap);
  }
  if (!options.junit.empty()) check_writable(options.junit);
}

void report(const std::vector<PairResult>& results, const Options& options) {
  const float ppd = options.compare.pixels_per_degree;
  if (!options.junit.empty()) write_text(options.junit, junit_xml(results));
  const bool several = has_several(options, results.front().pair);
  if (options.json) {
    const nlohmann::json json = several ? all_json(results, ppd) : pair_json(results.front(), ppd);
    std::printf("%s", json_text(json).c_str());
  } else if (several) {
    print_table(results);
  } else if (results.front().figures) {
    print_pair(results.front(), ppd);
  }
  std::fflush(stdout);  // before the line on stderr
}

int run(const Options& options) {
  const std::vector<PicturePair> pairs = find_pairs(options.a, options.b);
  check_files(options, pairs);
  Workers workers;
  std::vector<PairResult> results;
  for (const PicturePair& pair : pairs) {
    throw_if_cancelled(&run_progress());
    results.push_back(compare_pair(pair, options, heatmap_of(options, pair), workers));
  }
  report(results, options);
  const auto bad = [](const PairResult& result) { return result.code != kDone; };
  const auto count = std::ranges::count_if(results, bad);
  if (count == 0) return kDone;
  // A pair that cannot be compared is worse than one above a limit.
  const PairResult& worst = *std::ranges::find_if(results, [&](const PairResult& r) {
    return bad(r) && (r.code != kAboveLimit || std::ranges::all_of(results, [&](const PairResult& o) {
                        return !bad(o) || o.code == kAboveLimit;
                      }));
  });
  std::string line = worst.failure;
  if (count > 1) line += "; and " + std::to_string(count - 1) + " more of " + std::to_string(results.size());
  throw Exit(static_cast<ExitCode>(worst.code), line);
}

}  // namespace

Run add_compare(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App& verb =
      *program.add_subcommand("compare", "measure how much pictures differ from their references");
  verb.add_option("A", options->a,
                  "EXR or PNG; a folder of them; or a sequence, with #### in place of the frame's number")
      ->required();
  verb.add_option("B", options->b, "the references, of the same kind, names and sizes")->required();
  add_parsed(verb, "--ppd", "FLIP: pixels per degree of visual angle (67: a 4K screen at arm's length)",
             "a number of pixels per degree from 1 to 1000",
             number_within(kLeastPixelsPerDegree, kMostPixelsPerDegree), options->compare.pixels_per_degree)
      ->type_name("NUMBER");
  verb.add_option("--channel", options->compare.channels, "compare this channel too, such as Z; repeatable")
      ->allow_extra_args(false);
  verb.add_flag("--channels", options->compare.all_channels, "compare every channel that both files have");
  verb.add_option(
      "--heatmap", options->heatmap,
      "write FLIP's errors as a PNG, black to yellow; for folders and sequences, a folder of them");
  verb.add_option_function<std::vector<std::string>>(
          "--max-error",
          [options](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
              options->limits.push_back(parse_error_limit(text, kMetrics));
          },
          "METRIC=VALUE: exit code 5 where a pair is above it (psnr: below); rmse, relmse, psnr, max, flip "
          "or "
          "mask (share of bits, 0 to 1); repeatable")
      ->allow_extra_args(false);
  verb.add_flag("--json", options->json,
                "print the figures as JSON, for each pair and overall; an infinite PSNR is null");
  verb.add_option("--junit", options->junit,
                  "write a test case for each pair as JUnit's XML, for CI systems");
  return [options] { return run(*options); };
}

}  // namespace pinocchio::app
