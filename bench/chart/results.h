// The results of a chart, which are kept in its folder.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bench/chart/sweep.h"
#include "pinocchio/error.h"

namespace pinocchio::chart {

// One configuration, measured along the camera's motion.
struct PointFigures {
  double ratio_median = 0.0;               // to raster-only's time of the same round, by the run's clock
  double frame_ms = 0.0, raster_ms = 0.0;  // of the fastest consecutive frames
  double round_ms = 0.0, round_low_ms = 0.0, round_high_ms = 0.0;  // of whole rounds: median, least, most
  double cpu_ms = 0.0, raster_cpu_ms = 0.0;  // of all threads, per frame; least of the rounds
  double latency_ms = 0.0;  // from reading the camera to delivering the picture; least of the rounds' medians
  int latency_frames = 0, age_frames = 0;
  double bytes_gpu_to_cpu = 0.0, bytes_cpu_to_gpu = 0.0;  // a frame
  // Errors of the screen against the picture that it should show at that time; means over frames.
  std::string reference;  // Configuration::reference
  double rmse = 0.0, relative_mse = 0.0, flip = 0.0;
  double worst = 0.0;   // the largest difference of a pixel's colour, linear
  std::string failure;  // the reason why there are no errors: NaN or infinity in the picture
};
[[nodiscard]] nlohmann::json to_json(const PointFigures& figures);

// results.json and results.csv in a folder: {"run": ..., "points": [...]}. Each configuration has its ratio
// (its least time by the run's clock, divided by the least of raster-only in the whole run: other programs
// on the machine can only add time), axis, value, options, settings, figures, `picture` (the name of its
// files) and `pareto` (the charts that have it on their front: rmse, relmse, flip against the frame time,
// bytes against FLIP).
class Results {
 public:
  // `run`: the properties that continued runs must share (scene, size, cameras, machine, version). Reads the
  // folder's results. Errors: they are of another run (and what differs), or cannot be read.
  [[nodiscard]] static Expected<Results> open(const std::filesystem::path& folder, const nlohmann::json& run,
                                              bool restart);

  [[nodiscard]] bool has(const Configuration& configuration) const;
  // A point with the same settings and reference, on any axis: it need not be measured again.
  [[nodiscard]] const nlohmann::json* find_equal(const Configuration& configuration) const;

  // Adds the configuration with the figures and picture of a point, and writes both files, each whole or not
  // at all. Throws EnvironmentError.
  void add(const Configuration& configuration, const nlohmann::json& figures, const std::string& picture);

  // Writes both files, each whole or not at all. Throws EnvironmentError.
  void write();

  [[nodiscard]] const nlohmann::json& json() const { return json_; }

 private:
  Results(std::filesystem::path folder, nlohmann::json json)
      : folder_(std::move(folder)), json_(std::move(json)) {}
  void set_ratios();
  void mark_fronts();
  [[nodiscard]] std::string csv() const;

  std::filesystem::path folder_;
  nlohmann::json json_;
};

}  // namespace pinocchio::chart
