#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pinocchio {

// Packs lines of pixels as OpenEXR's ZIP and ZIPS do; the bytes stay as they are if packing does not shorten
// them. OpenEXR 3.1 uses zlib, libdeflate takes less than half of its time, ISA-L a third of libdeflate's
// (docs/measurements.md). ISA-L's bytes depend on the processor; if `reproducible`, libdeflate packs.
[[nodiscard]] std::vector<std::byte> pack_zip(std::span<const std::byte> lines, bool reproducible);

}  // namespace pinocchio
