#include "bench/chart/ground_truth.h"

#include <algorithm>
#include <optional>
#include <string>

#include "core/image/rgb.h"
#include "core/math/finite.h"
#include "core/reference/reference.h"
#include "pinocchio/exr.h"

namespace pinocchio::chart {

namespace {

constexpr const char* kChannels[] = {"R", "G", "B"};

// In single precision, as for the comparison.
void write_reference(const std::filesystem::path& file, const Image<glm::vec3>& picture) {
  ExrFile exr;
  exr.display_size = picture.size();
  exr.data_window = {{0, 0}, picture.size()};
  for (int i = 0; i < 3; ++i) {
    ExrChannel& channel = exr.channels.emplace_back();
    channel.name = kChannels[i];
    channel.type = ExrChannel::Type::real;
    for (const glm::vec3& pixel : picture.pixels()) channel.values.push_back(pixel[i]);
  }
  write_exr(file, exr);
}

// Empty: there is no such file, or its size differs.
std::optional<Image<glm::vec3>> read_reference(const std::filesystem::path& file, const glm::ivec2& size) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  const Expected<ExrFile> exr = read_exr(file);
  if (!exr || exr->display_size != size) return std::nullopt;
  Image<glm::vec3> picture(size);
  for (int i = 0; i < 3; ++i) {
    const ExrChannel* const channel = exr->find(kChannels[i]);
    if (!channel || channel->values.size() != picture.pixels().size()) return std::nullopt;
    for (std::size_t k = 0; k < channel->values.size(); ++k) picture[k][i] = channel->values[k];
  }
  return picture;
}

}  // namespace

const Image<glm::vec3>& GroundTruth::reference(std::size_t frame, bool area) {
  const auto known = references_.find({frame, area});
  if (known != references_.end()) return known->second;
  const std::filesystem::path file =
      folder_ / ((area ? "reference-area-" : "reference-centre-") + std::to_string(frame) + ".exr");
  std::optional<Image<glm::vec3>> picture = read_reference(file, views_[frame].box().size());
  if (!picture) {
    picture = draw(frame, area);
    write_reference(file, *picture);
  }
  return references_.emplace(std::pair(frame, area), std::move(*picture)).first->second;
}

Image<glm::vec3> GroundTruth::draw(std::size_t frame, bool area) const {
  const int side = area ? area_side_ : 1;
  View view = views_[frame];
  Image<glm::vec3> mean(view.box().size());
  for (int k = 0; k < side * side; ++k) {
    const glm::vec2 place(static_cast<float>(k % side), static_cast<float>(k / side));
    view.jitter = (place + 0.5f) / static_cast<float>(side) - 0.5f;
    const Image<glm::vec3> sample = rgb_of(reference_render(scene_, view, depth_, workers_, progress_).color);
    for (std::size_t i = 0; i < mean.pixels().size(); ++i)
      mean[i] += sample[i] / static_cast<float>(side * side);
  }
  return mean;
}

void forget_references(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path& file = entry.path();
    if (file.filename().string().starts_with("reference-") && file.extension() == ".exr") old.push_back(file);
  }
  for (const std::filesystem::path& file : old) std::filesystem::remove(file);
}

MeasuredError GroundTruth::measure(const Image<glm::vec4>& color, std::size_t frame, bool area) {
  const Image<glm::vec3>& truth = reference(frame, area);
  const Image<glm::vec3> rgb = rgb_of(color);
  const auto finite = std::ranges::count_if(rgb.pixels(), is_finite<3>);
  const std::size_t not_finite = rgb.pixels().size() - static_cast<std::size_t>(finite);
  if (not_finite > 0) return {{}, not_finite};
  return {picture_error(rgb, truth, kFlipPixelsPerDegree, workers_)};
}

}  // namespace pinocchio::chart
