#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/rays/shadow_pass.h"
#include "bench/rays/sides/measure.h"
#include "bench/rays/whole_frame.h"

namespace pinocchio::bench {

// The results of a run of the program.
struct Report {
  std::string scene;
  std::size_t triangles = 0;
  std::string tree;  // split rule
  bool robust = false;
  bool all_mirrors = false;  // all materials are mirrors
  int repeat = 0;
  BuildCost ours, wide, embree;
  std::vector<Speed> speeds;
  std::vector<ShadowPass> shadow_passes;
  std::vector<WholeFrame> frames;
};

// Prints tables to stdout.
void print_report(const Report& report);

// Writes the same and the machine as JSON. Throws EnvironmentError if the file cannot be written.
void save_report(const Report& report, const std::filesystem::path& file);

}  // namespace pinocchio::bench
