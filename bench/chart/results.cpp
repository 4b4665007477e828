#include "bench/chart/results.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <sstream>
#include <system_error>

#include "core/files/atomic_file.h"
#include "core/math/pareto.h"
#include "hybrid/settings/json.h"

namespace pinocchio::chart {
namespace {

constexpr std::array kFigures{"ratio",
                              "ratio_median",
                              "frame_ms",
                              "raster_ms",
                              "cpu_ms",
                              "raster_cpu_ms",
                              "round_ms",
                              "round_low_ms",
                              "round_high_ms",
                              "latency_ms",
                              "latency_frames",
                              "age_frames",
                              "bytes_gpu_to_cpu",
                              "bytes_cpu_to_gpu",
                              "reference",
                              "rmse",
                              "relmse",
                              "flip",
                              "worst"};

// A chart: its name and its axes.
struct Front {
  const char* name;
  double (*cost)(const nlohmann::json&);
  const char* error;
};
double ratio_of(const nlohmann::json& point) {
  return point["ratio"].get<double>();
}
// A configuration without exchange is on no chart of the exchange.
double bytes_of(const nlohmann::json& point) {
  const double bytes = point["bytes_gpu_to_cpu"].get<double>() + point["bytes_cpu_to_gpu"].get<double>();
  return bytes > 0.0 ? bytes : std::numeric_limits<double>::quiet_NaN();
}
constexpr std::array kFronts{Front{"rmse", ratio_of, "rmse"}, Front{"relmse", ratio_of, "relmse"},
                             Front{"flip", ratio_of, "flip"}, Front{"bytes", bytes_of, "flip"}};

Unexpected refused(const std::filesystem::path& file, const std::string& what) {
  return Unexpected(
      InputError{file.string(), 0, what, "name another folder, or begin afresh with --restart"});
}

bool is_point(const nlohmann::json& point) {
  const auto has = [&](const char* key) { return point.contains(key); };
  return point.is_object() && has("axis") && has("value") && has("options") && has("settings") &&
         has("picture") && std::all_of(kFigures.begin(), kFigures.end(), has);
}

bool is_results(const nlohmann::json& json) {
  return json.is_object() && json.contains("run") && json["run"].is_object() && json.contains("points") &&
         json["points"].is_array() && std::all_of(json["points"].begin(), json["points"].end(), is_point);
}

// Bytes that are not UTF-8, as names of files may have, are replaced.
std::string text_of(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

// The same json after writing and reading the file.
nlohmann::json as_written(const nlohmann::json& json) {
  return nlohmann::json::parse(text_of(json));
}

// The property that differs between two runs, the scene before properties that depend on it; empty: none.
std::string difference(const nlohmann::json& old_run, const nlohmann::json& run) {
  if (old_run.value("scene", nlohmann::json()) != run.at("scene")) return "scene";
  for (const auto& [key, value] : run.items())
    if (!old_run.contains(key) || old_run[key] != value) return key;
  return old_run.size() == run.size() ? "" : "version";
}

std::string quoted(const std::string& text) {
  return text.find_first_of(",\"\n") == std::string::npos ? text : "\"" + text + "\"";
}

std::string cell(const nlohmann::json& value) {
  return value.is_null() ? "" : value.is_string() ? quoted(value.get<std::string>()) : value.dump();
}

// The first point of each setting, if it has an error. Each ground truth has a chart of its own.
std::vector<std::size_t> on_charts(const nlohmann::json& points) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i]["reference"] != "centre" || points[i]["flip"].is_null()) continue;
    const bool seen = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t k) {
      return points[k]["settings"] == points[i]["settings"];
    });
    if (!seen) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace

nlohmann::json to_json(const PointFigures& f) {
  nlohmann::json json{{"ratio_median", f.ratio_median},
                      {"frame_ms", f.frame_ms},
                      {"round_ms", f.round_ms},
                      {"round_low_ms", f.round_low_ms},
                      {"round_high_ms", f.round_high_ms},
                      {"raster_ms", f.raster_ms},
                      {"cpu_ms", f.cpu_ms},
                      {"raster_cpu_ms", f.raster_cpu_ms},
                      {"latency_ms", f.latency_ms},
                      {"latency_frames", f.latency_frames},
                      {"age_frames", f.age_frames},
                      {"bytes_gpu_to_cpu", f.bytes_gpu_to_cpu},
                      {"bytes_cpu_to_gpu", f.bytes_cpu_to_gpu},
                      {"reference", f.reference},
                      {"rmse", f.rmse},
                      {"relmse", f.relative_mse},
                      {"flip", f.flip},
                      {"worst", f.worst}};
  if (f.failure.empty()) return json;
  for (const char* error : {"rmse", "relmse", "flip", "worst"}) json[error] = nullptr;
  json["failure"] = f.failure;
  return json;
}

Expected<Results> Results::open(const std::filesystem::path& folder, const nlohmann::json& given_run,
                                bool restart) {
  const std::filesystem::path file = folder / "results.json";
  std::error_code ignored;
  nlohmann::json fresh{{"run", as_written(given_run)}, {"points", nlohmann::json::array()}};
  const nlohmann::json& run = fresh["run"];
  if (restart || !std::filesystem::exists(file, ignored)) return Results(folder, std::move(fresh));
  std::ifstream in(file);
  nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!is_results(json)) return refused(file, "is no chart's results");
  const std::string differs = difference(json["run"], run);
  if (!differs.empty()) return refused(file, "is the chart of another run (" + differs + " differs)");
  return Results(folder, std::move(json));
}

bool Results::has(const Configuration& c) const {
  const nlohmann::json settings = to_json(c.settings);
  return std::any_of(json_["points"].begin(), json_["points"].end(), [&](const nlohmann::json& point) {
    return point["axis"] == c.axis && point["value"] == c.value && point["settings"] == settings;
  });
}

const nlohmann::json* Results::find_equal(const Configuration& c) const {
  const nlohmann::json wanted = to_json(c.settings);
  for (const nlohmann::json& point : json_["points"])
    if (point["settings"] == wanted && point["reference"] == c.reference) return &point;
  return nullptr;
}

void Results::add(const Configuration& c, const nlohmann::json& figures, const std::string& picture) {
  nlohmann::json point{{"axis", c.axis},
                       {"value", c.value},
                       {"options", c.options},
                       {"settings", to_json(c.settings)},
                       {"picture", picture}};
  for (const char* name : kFigures) point[name] = figures.value(name, nlohmann::json());
  if (figures.contains("failure")) point["failure"] = figures["failure"];
  json_["points"].push_back(std::move(point));
  write();
}

void Results::write() {
  set_ratios();
  mark_fronts();
  write_text(folder_ / "results.json", text_of(json_) + "\n");
  write_text(folder_ / "results.csv", csv());
}

void Results::set_ratios() {
  const bool by_cpu = json_["run"]["clock"] == "cpu";
  const char* const time = by_cpu ? "cpu_ms" : "frame_ms";
  const char* const raster = by_cpu ? "raster_cpu_ms" : "raster_ms";
  double least = std::numeric_limits<double>::infinity();
  for (const nlohmann::json& point : json_["points"]) least = std::min(least, point[raster].get<double>());
  for (nlohmann::json& point : json_["points"]) point["ratio"] = point[time].get<double>() / least;
}

void Results::mark_fronts() {
  nlohmann::json& points = json_["points"];
  for (nlohmann::json& point : points) point["pareto"] = nlohmann::json::array();
  const std::vector<std::size_t> charted = on_charts(points);
  for (const Front& front : kFronts) {
    std::vector<CostAndError> costs;
    for (const std::size_t i : charted)
      costs.push_back({front.cost(points[i]), points[i][front.error].get<double>()});
    for (const std::size_t k : pareto_front(costs)) points[charted[k]]["pareto"].push_back(front.name);
  }
}

std::string Results::csv() const {
  std::ostringstream out;
  out << "axis,value,options";
  for (const char* name : kFigures) out << ',' << name;
  out << ",pareto\n";
  for (const nlohmann::json& point : json_["points"]) {
    out << cell(point["axis"]) << ',' << cell(point["value"]) << ',' << cell(point["options"]);
    for (const char* name : kFigures) out << ',' << cell(point[name]);
    std::string fronts;
    for (const nlohmann::json& name : point["pareto"])
      fronts += (fronts.empty() ? "" : " ") + name.get<std::string>();
    out << ',' << fronts << '\n';
  }
  return out.str();
}

}  // namespace pinocchio::chart
