#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pinocchio {

// Packs lines of pixels as OpenEXR's ZIP and ZIPS do; the bytes stay as they are if packing does not shorten
// them. ISA-L packs, whose bytes depend on the processor; if `reproducible`, libdeflate, which is slower.
// Both are faster than the zlib of OpenEXR 3.1 (docs/measurements.md).
[[nodiscard]] std::vector<std::byte> pack_zip(std::span<const std::byte> lines, bool reproducible);

}  // namespace pinocchio
