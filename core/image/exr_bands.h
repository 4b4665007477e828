#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/parallel/workers.h"
#include "pinocchio/exr.h"

namespace pinocchio {

// The channels with the values of lines [y0, y1) of the data window, counted from its top. Called on many
// threads at once.
using ExrBand = std::function<std::vector<ExrChannel>(int y0, int y1)>;

// write_exr() of a file that is never whole in memory: `header` has its channels without values, `band` makes
// them as they are packed, on all threads. The same bytes for any number of them.
void write_exr(const std::filesystem::path& file, const ExrFile& header, Workers& workers,
               const ExrBand& band, Progress* progress = nullptr);

}  // namespace pinocchio
