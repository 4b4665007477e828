#pragma once

#include <filesystem>

#include "pinocchio/progress.h"

namespace pinocchio::chart {

// Draws index.html with its charts from the folder's results.json, with Python and matplotlib (plot.py and
// charts.py). False: one of the two is missing. Throws EnvironmentError if they fail, and Cancelled. Python
// is ended on cancellation, and if this process dies.
[[nodiscard]] bool draw_page(const std::filesystem::path& folder, const Progress& progress);

}  // namespace pinocchio::chart
