// Two EXR pictures, one against the other.
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
  std::string name;  // as errors say it
  ExrFile exr;
};

struct CompareOptions {
  float pixels_per_degree = kFlipPixelsPerDegree;
  std::vector<std::string> channels;  // compared one by one beside RGB
  bool all_channels = false;          // all that both files have
};

struct Comparison : PictureError {  // of the data window
  std::optional<MaskFigures> mask;
  std::string no_mask;                                           // why there is no `mask`
  std::vector<std::pair<std::string, ChannelFigures>> channels;  // by name, in the order asked
};

// `b` is the reference. Errors: other sizes or windows; R, G, B or a channel asked for is missing; NaN or
// infinity in R, G or B (how many pixels, and the first of them).
[[nodiscard]] Expected<Comparison> compare(const NamedExr& a, const NamedExr& b,
                                           const CompareOptions& options, Workers& workers);

}  // namespace pinocchio
