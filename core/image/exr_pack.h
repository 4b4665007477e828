#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pinocchio {

// Lines of pixels as ZIP and ZIPS of OpenEXR hold them; the bytes as they are where that is no shorter.
// OpenEXR 3.1 packs with zlib: libdeflate takes less than half the time (docs/measurements.md).
[[nodiscard]] std::vector<std::byte> pack_zip(std::span<const std::byte> lines);

}  // namespace pinocchio
