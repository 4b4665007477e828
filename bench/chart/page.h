#pragma once

#include <filesystem>

#include "pinocchio/progress.h"

namespace pinocchio::chart {

// Draws index.html with its charts out of the folder's results.json: Python and matplotlib do, by plot.py and
// charts.py. False where one of the two is missing. Throws EnvironmentError where they are there and fail,
// Cancelled where it is; Python is ended then, and also where this process dies.
[[nodiscard]] bool draw_page(const std::filesystem::path& folder, const Progress& progress);

}  // namespace pinocchio::chart
