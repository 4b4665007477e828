#include "app/report/compare_report.h"

#include <algorithm>
#include <boost/locale/encoding_utf.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/cli/errors.h"
#include "core/base/decimal.h"

namespace pinocchio::app {
namespace {

// The explanation beside a figure.
std::string remark(const Comparison& result, float pixels_per_degree, const std::string_view metric) {
  if (metric == "relmse") return "mean of (a - b)^2 / (b^2 + 0.01)";
  if (metric == "psnr") return "dB, peak 1, of the values clamped to [0, 1]";
  if (metric == "flip")
    return "mean LDR-FLIP, clamped to [0, 1] and sRGB, " + decimal(pixels_per_degree) + " pixels per degree";
  if (metric != "mask") return "";
  if (!result.mask) return "not compared: " + result.no_mask;
  return "share of shadow.mask bits that differ: " + std::to_string(result.mask->differing) + " of " +
         std::to_string(result.mask->bits);
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

// Over the pairs that have the metric: the worst (the lowest PSNR) and the mean.
struct Overall {
  std::optional<double> worst;
  double mean = 0.0;
};
Overall overall(const std::vector<PairResult>& results, std::string_view metric) {
  Overall all;
  double sum = 0.0, count = 0.0;
  for (const PairResult& result : results) {
    const std::optional<double> value = result.figures ? figure(*result.figures, metric) : std::nullopt;
    if (!value) continue;
    const bool worse = !all.worst || (metric == "psnr" ? *value < *all.worst : *value > *all.worst);
    if (worse) all.worst = value;
    sum += *value;
    ++count;
  }
  if (count > 0.0) all.mean = sum / count;
  return all;
}

nlohmann::json finite_json(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json();
}

std::string xml_text(const std::string& text) {
  constexpr std::array<std::pair<char, const char*>, 4> kEscapes{
      {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}}};
  std::string escaped;
  for (const char c : boost::locale::conv::utf_to_utf<char>(text)) {  // without bytes that are not UTF-8
    const auto* const found = std::ranges::find(kEscapes, c, &std::pair<char, const char*>::first);
    if (found != kEscapes.end())
      escaped += found->second;
    else
      escaped += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return escaped;
}

}  // namespace

std::optional<double> figure(const Comparison& result, const std::string_view metric) {
  if (metric == "rmse") return result.rgb.rmse;
  if (metric == "relmse") return result.rgb.relative_mse;
  if (metric == "psnr") return result.rgb.psnr_db;
  if (metric == "max") return result.rgb.max_difference;
  if (metric == "flip") return result.mean_flip;
  if (result.mask) return result.mask->share();
  return std::nullopt;
}

void print_pair(const PairResult& result, float pixels_per_degree) {
  std::printf("%s against %s\n", result.pair.a.c_str(), result.pair.b.c_str());
  for (const std::string_view metric : kMetrics) {
    const std::optional<double> value = figure(*result.figures, metric);
    const std::string text = remark(*result.figures, pixels_per_degree, metric);
    std::printf("  %-7s %s\n", metric.data(),
                ((value ? decimal(*value) : "-") + (text.empty() ? "" : "  " + text)).c_str());
  }
  for (const auto& [name, c] : result.figures->channels) {
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
  if (!result.heatmap.empty()) std::printf("%s\n", result.heatmap.c_str());
}

void print_table(const std::vector<PairResult>& results) {
  std::size_t longest = std::string_view("picture").size();
  for (const PairResult& result : results) longest = std::max(longest, result.pair.name.size());
  const int width = longest;
  const auto row = [width](const std::string& name, const auto& value_of) {
    std::printf("%-*s", width, name.c_str());
    for (const std::string_view metric : kMetrics) {
      const std::optional<double> value = value_of(metric);
      std::printf(" %12s", value ? decimal(*value).c_str() : "-");
    }
    std::printf("\n");
  };
  std::printf("%-*s", width, "picture");
  for (const std::string_view metric : kMetrics) std::printf(" %12s", metric.data());
  std::printf("\n");
  for (const PairResult& result : results) {
    row(result.pair.name, [&](std::string_view metric) {
      return result.figures ? figure(*result.figures, metric) : std::nullopt;
    });
    if (!result.failure.empty()) std::printf("  %s\n", result.failure.c_str());
  }
  row("worst", [&](std::string_view metric) { return overall(results, metric).worst; });
  row("mean", [&](std::string_view metric) {
    const Overall all = overall(results, metric);
    return all.worst ? std::optional(all.mean) : std::nullopt;
  });
}

nlohmann::json pair_json(const PairResult& result, float pixels_per_degree) {
  nlohmann::json json{{"a", result.pair.a.string()}, {"b", result.pair.b.string()}};
  if (!result.failure.empty()) json["failure"] = result.failure;
  if (!result.figures) return json;
  json["size"] = {result.size.x, result.size.y};
  json["pixels_per_degree"] = pixels_per_degree;
  json["mask_bits"] = nullptr;
  json["channels"] = nlohmann::json::object();
  for (const std::string_view metric : kMetrics)
    json[std::string(metric)] = finite_json(figure(*result.figures, metric));
  if (const auto& mask = result.figures->mask)
    json["mask_bits"] = {{"slots", mask->slots}, {"compared", mask->bits}, {"differing", mask->differing}};
  for (const auto& [name, figures] : result.figures->channels) json["channels"][name] = channel_json(figures);
  if (!result.heatmap.empty()) json["heatmap"] = result.heatmap;
  return json;
}

nlohmann::json all_json(const std::vector<PairResult>& results, float pixels_per_degree) {
  nlohmann::json json{{"pairs", nlohmann::json::array()}};
  for (const PairResult& result : results) {
    json["pairs"].push_back(pair_json(result, pixels_per_degree));
    json["pairs"].back()["name"] = result.pair.name;
  }
  json["failures"] = std::ranges::count_if(results, [](const PairResult& r) { return !r.failure.empty(); });
  for (const std::string_view metric : kMetrics) {
    const Overall all = overall(results, metric);
    json["overall"][std::string(metric)] = {
        {"worst", finite_json(all.worst)},
        {"mean", finite_json(all.worst ? std::optional(all.mean) : std::nullopt)}};
  }
  return json;
}

std::string junit_xml(const std::vector<PairResult>& results) {
  const auto count = [&](auto is) { return std::to_string(std::ranges::count_if(results, is)); };
  const std::string failures = count([](const PairResult&r) { return r.code == kAboveLimit; }),
                    errors =
                        count([](const PairResult&r) { return r.code != kDone && r.code != kAboveLimit; });
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"pinocchio compare\" "
      "tests=\"" +
      std::to_string(results.size()) + "\" failures=\"" + failures + "\" errors=\"" + errors + "\">\n";
  for (const PairResult& result : results) {
    xml += "    <testcase classname=\"compare\" name=\"" + xml_text(result.pair.name) + "\">\n";
    if (result.code != kDone) {
      const std::string kind = result.code == kAboveLimit ? "failure" : "error";
      xml += "      <" + kind + " message=\"" + xml_text(result.failure) + "\"/>\n";
    }
    if (result.figures) {
      xml += "      <system-out>";
      for (const std::string_view metric : kMetrics)
        if (const std::optional<double> value = figure(*result.figures, metric))
          xml += std::string(metric) + " " + decimal(*value) + "\n";
      xml += xml_text(result.heatmap) + "</system-out>\n";
    }
    xml += "    </testcase>\n";
  }
  return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace pinocchio::app
