// The results of `compare` as text, JSON and JUnit.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/compare_pairs.h"
#include "core/compare/comparison.h"

namespace pinocchio::app {

inline constexpr std::array<std::string_view, 6> kMetrics{"rmse", "relmse", "psnr", "max", "flip", "mask"};

// One pair's result, without the heat map, which is written and freed.
struct PairResult {
  PicturePair pair;
  glm::ivec2 size{0, 0};
  std::optional<Comparison> figures;  // nothing: they could not be compared
  std::string failure;                // one line: why not, or the limits that are exceeded. Empty: neither
  int code = 0;                       // exit code
  std::string heatmap;
};

// Nothing: the metric has no figure here.
[[nodiscard]] std::optional<double> figure(const Comparison& result, std::string_view metric);

void print_pair(const PairResult& result, float pixels_per_degree);
// A line for each pair, then the worst and the mean of each metric.
void print_table(const std::vector<PairResult>& results);

[[nodiscard]] nlohmann::json pair_json(const PairResult& result, float pixels_per_degree);
[[nodiscard]] nlohmann::json all_json(const std::vector<PairResult>& results, float pixels_per_degree);
// JUnit's XML, for CI systems: a test case for each pair.
[[nodiscard]] std::string junit_xml(const std::vector<PairResult>& results);

}  // namespace pinocchio::app
