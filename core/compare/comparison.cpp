#include "core/compare/comparison.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/math/finite.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

std::string text_of(glm::ivec2 v, const char* between) {
  return std::to_string(v.x) + between + std::to_string(v.y);
}

std::string text_of(const PixelBox& box) {
  return text_of(box.size(), "x") + " at (" + text_of(box.lo, ", ") + ")";
}

Expected<void> check_sizes(const NamedExr& a, const NamedExr& b) {
  const auto error = [&](const std::string& what, const std::string& of_a, const std::string& of_b) {
    return Unexpected(InputError{a.name, 0, what + " is " + of_a + ", that of " + b.name + " is " + of_b,
                                 "only pictures of the same size and part can be compared"});
  };
  if (a.exr.display_size != b.exr.display_size)
    return error("the picture's size", text_of(a.exr.display_size, "x"), text_of(b.exr.display_size, "x"));
  if (!(a.exr.data_window == b.exr.data_window))
    return error("the data window", text_of(a.exr.data_window), text_of(b.exr.data_window));
  return {};
}

Expected<const ExrChannel*> channel_of(const NamedExr& file, const std::string& name) {
  if (const ExrChannel* channel = file.exr.find(name)) return channel;
  std::string names;
  for (const ExrChannel& channel : file.exr.channels) names += (names.empty() ? "" : ", ") + channel.name;
  return Unexpected(InputError{file.name, 0, "has no channel '" + name + "'", "it has " + names});
}

Expected<void> check_finite(const NamedExr& file, const Image<glm::vec3>& rgb) {
  std::size_t count = 0;
  glm::ivec2 first(0);
  for (int y = rgb.height() - 1; y >= 0; --y)
    for (int x = rgb.width() - 1; x >= 0; --x) {
      if (is_finite(rgb.at(x, y))) continue;
      ++count;
      first = {x, y};
    }
  if (count == 0) return {};
  return Unexpected(InputError{file.name, 0,
                               "NaN or infinity in R, G or B of " + std::to_string(count) + " pixel" +
                                   (count == 1 ? "" : "s") + ", first at (" +
                                   text_of(first + file.exr.data_window.lo, ", ") + ")",
                               "no error figure can be given"});
}

// The picture in R, G and B; an error where one is missing, or is of integers, NaN or infinity.
Expected<Image<glm::vec3>> rgb_of(const NamedExr& file) {
  Image<glm::vec3> rgb(file.exr.data_window.size());
  const std::array<const char*, 3> names{"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    const auto channel = channel_of(file, names[c]);
    if (!channel) return Unexpected(channel.error());
    if ((*channel)->type == ExrChannel::Type::uint)
      return Unexpected(InputError{file.name, 0, "its R, G and B are integers", "colours are half or float"});
    for (std::size_t i = 0; i < (*channel)->values.size(); ++i) rgb[i][c] = (*channel)->values[i];
  }
  if (const auto finite = check_finite(file, rgb); !finite) return Unexpected(finite.error());
  return rgb;
}

// The number of slots in the header's list of casting lights; 0 without a readable list.
int named_slots(const ExrFile& exr) {
  const auto found = exr.attributes.find("pinocchio.lights");
  if (found == exr.attributes.end() || !std::holds_alternative<std::string>(found->second)) return 0;
  const auto lights = nlohmann::json::parse(std::get<std::string>(found->second), nullptr, false);
  return lights.is_array() ? as_int(lights.size()) : 0;
}

const ExrChannel* uint_channel(const ExrFile& exr, const std::string& name) {
  const ExrChannel* channel = exr.find(name);
  return channel && channel->type == ExrChannel::Type::uint ? channel : nullptr;
}

void compare_masks(const NamedExr& a, const NamedExr& b, Comparison& result) {
  std::array<MaskedPixels, 2> masked;
  std::size_t i = 0;
  for (const NamedExr* file : {&a, &b}) {
    const ExrChannel* mask = uint_channel(file->exr, "shadow.mask");
    if (!mask) {
      result.no_mask = file->name + " has no integer channel 'shadow.mask'";
      return;
    }
    const ExrChannel* ids = uint_channel(file->exr, "id.triangle");
    masked[i].mask.emplace_back(mask->uints);
    for (int k = 1; (mask = uint_channel(file->exr, "shadow.mask" + std::to_string(k))); ++k)
      masked[i].mask.emplace_back(mask->uints);
    if (ids) masked[i].ids = ids->uints;
    ++i;
  }
  result.mask = mask_figures(masked[0], masked[1], std::max(named_slots(a.exr), named_slots(b.exr)));
}

std::vector<std::string> names_asked(const NamedExr& a, const NamedExr& b, const CompareOptions& options) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const std::string& name : options.channels) add(name);
  if (options.all_channels)
    for (const ExrChannel& channel : a.exr.channels)
      if (b.exr.find(channel.name)) add(channel.name);
  return names;
}

Expected<void> compare_channels(const NamedExr& a, const NamedExr& b, const CompareOptions& options,
                                Comparison& result) {
  for (const std::string& name : names_asked(a, b, options)) {
    const auto in_a = channel_of(a, name), in_b = channel_of(b, name);
    if (!in_a) return Unexpected(in_a.error());
    if (!in_b) return Unexpected(in_b.error());
    const bool integers = (*in_a)->type == ExrChannel::Type::uint;
    if (integers != ((*in_b)->type == ExrChannel::Type::uint))
      return Unexpected(InputError{a.name, 0,
                                   "channel '" + name + "' holds " + (integers ? "integers" : "numbers") +
                                       ", that of " + b.name + " does not",
                                   "they cannot be compared"});
    result.channels.emplace_back(name, integers ? channel_figures((*in_a)->uints, (*in_b)->uints)
                                                : channel_figures((*in_a)->values, (*in_b)->values));
  }
  return {};
}

}  // namespace

Expected<Comparison> compare(const NamedExr& a, const NamedExr& b, const CompareOptions& options,
                             Workers& workers, Progress* progress) {
  if (const auto same = check_sizes(a, b); !same) return Unexpected(same.error());
  const auto rgb_a = rgb_of(a);
  if (!rgb_a) return Unexpected(rgb_a.error());
  const auto rgb_b = rgb_of(b);
  if (!rgb_b) return Unexpected(rgb_b.error());
  Comparison result;
  if (const auto done = compare_channels(a, b, options, result); !done) return Unexpected(done.error());
  compare_masks(a, b, result);
  static_cast<PictureError&>(result) =
      picture_error(*rgb_a, *rgb_b, options.pixels_per_degree, workers, progress);
  return result;
}

}  // namespace pinocchio
