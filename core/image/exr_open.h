#pragma once

#include <ImfInputFile.h>

#include <cstdint>
#include <filesystem>
#include <memory>

#include "pinocchio/exr.h"

namespace pinocchio {

// Bytes of pixels that any EXR's header may speak of; of more, only a file that can hold them.
inline constexpr std::uint64_t kUsualExrClaim = std::uint64_t{1} << 30;

// Opens an EXR. OpenEXR takes memory for a band of lines as it opens one, so the header is looked at before.
// Throws std::exception where it is none, or its header speaks of more than `claim_bytes` and than the file
// can hold.
[[nodiscard]] std::unique_ptr<Imf::InputFile> open_exr(const std::filesystem::path& file,
                                                       std::uint64_t claim_bytes = kUsualExrClaim);
// Reads it whole, by the same limit.
[[nodiscard]] Expected<ExrFile> read_exr(const std::filesystem::path& file, std::uint64_t claim_bytes);

}  // namespace pinocchio
