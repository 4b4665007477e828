#pragma once

#include <ImfInputFile.h>

#include <cstdint>
#include <filesystem>
#include <memory>

#include "pinocchio/exr.h"

namespace pinocchio {

// The bytes of pixels that any EXR's header may claim. Only a file that is large enough may claim more.
inline constexpr std::uint64_t kUsualExrClaim = std::uint64_t{1} << 30;

// Opens an EXR. The header is checked first, because OpenEXR allocates memory for a band of lines when it
// opens a file. Throws std::exception if the file is not an EXR, or if its header claims more than
// `claim_bytes` and than the file can hold.
[[nodiscard]] std::unique_ptr<Imf::InputFile> open_exr(const std::filesystem::path& file,
                                                       std::uint64_t claim_bytes = kUsualExrClaim);
// Reads the whole file, with the same limit.
[[nodiscard]] Expected<ExrFile> read_exr(const std::filesystem::path& file, std::uint64_t claim_bytes);

}  // namespace pinocchio
