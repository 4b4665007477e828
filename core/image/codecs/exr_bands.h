#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/parallel/workers.h"
#include "pinocchio/exr.h"

namespace pinocchio {

// Makes the channels with the values of lines [y0, y1) of the data window, counted from its top. Called on
// many threads at once.
using ExrBand = std::function<std::vector<ExrChannel>(int y0, int y1)>;

// write_exr() for a picture that is never whole in memory: `header` has the channels without values, `band`
// makes the values, on all threads. The bytes do not depend on the number of threads.
void write_exr(const std::filesystem::path& file, const ExrFile& header, Workers& workers,
               const ExrBand& band, Progress* progress = nullptr);

}  // namespace pinocchio
