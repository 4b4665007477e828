// The comparison of two EXR pictures.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/compare/picture_error.h"
#include "pinocchio/error.h"
#include "pinocchio/exr.h"

namespace pinocchio {

struct NamedExr {
  std::string name;  // for errors
  ExrFile exr;
};

struct CompareOptions {
  float pixels_per_degree = kFlipPixelsPerDegree;
  std::vector<std::string> channels;  // compared one by one, in addition to RGB
  bool all_channels = false;          // all channels of both files
};

struct Comparison : PictureError {  // over the data window
  std::optional<MaskFigures> mask;
  std::string no_mask;                                           // the reason why there is no `mask`
  std::vector<std::pair<std::string, ChannelFigures>> channels;  // by name, in the requested order
};

// `b` is the reference. Errors: different sizes or windows; R, G, B or a requested channel is missing; NaN or
// infinity in R, G or B (with the number of pixels, and the first one).
[[nodiscard]] Expected<Comparison> compare(const NamedExr& a, const NamedExr& b,
                                           const CompareOptions& options, Workers& workers,
                                           Progress* progress = nullptr);

}  // namespace pinocchio
