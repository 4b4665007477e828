#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pinocchio {

// Packs lines of pixels as OpenEXR's ZIP and ZIPS do; the bytes stay as they are if packing does not shorten
// them. OpenEXR 3.1 uses zlib: libdeflate takes less than half the time (docs/measurements.md).
[[nodiscard]] std::vector<std::byte> pack_zip(std::span<const std::byte> lines);

}  // namespace pinocchio
