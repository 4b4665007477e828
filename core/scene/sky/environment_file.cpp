#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/decimal.h"
#include "core/files/input_file.h"
#include "core/files/memory_limit.h"
#include "core/image/codecs/formats.h"
#include "pinocchio/environment.h"
#include "pinocchio/load.h"
#include "pinocchio/studio.h"

namespace pinocchio {
namespace {

Expected<Image<glm::vec3>> read_environment(const std::filesystem::path& file, Progress* progress,
                                            MemoryLimit& limit) {
  const Expected<FileBytes> bytes = read_input_file(file, progress);
  if (!bytes) return Unexpected(bytes.error());
  const PictureFormat* const format = format_of(bytes->unsigned_bytes());
  if (format && format->decode_light)
    return format->decode_light({file.string(), file.filename().string(), bytes->unsigned_bytes(), limit});
  return Unexpected(InputError{file.string(), 0, "is neither EXR nor Radiance (.hdr)",
                               "an environment is a picture of all directions in latitude and longitude"});
}

// Pixels that are not finite would leave blotches, black ones at the sun.
void repair(const std::filesystem::path& file, Image<glm::vec3>& image, Warnings& warnings) {
  float largest = 0.0f;
  std::size_t not_numbers = 0, infinite = 0, negative = 0;
  for (const glm::vec3& pixel : image.pixels()) {
    bool is_infinite = false, is_nan = false, is_negative = false;
    for (int c = 0; c < 3; ++c) {
      is_nan |= std::isnan(pixel[c]);
      is_infinite |= std::isinf(pixel[c]);
      is_negative |= pixel[c] < 0.0f && std::isfinite(pixel[c]);
      if (std::isfinite(pixel[c])) largest = std::max(largest, pixel[c]);
    }
    not_numbers += is_nan ? 1 : 0;
    infinite += is_infinite ? 1 : 0;
    negative += is_negative ? 1 : 0;
  }
  if (negative > 0) {
    for (glm::vec3& pixel : image.pixels())
      for (int c = 0; c < 3; ++c)
        if (pixel[c] < 0.0f && std::isfinite(pixel[c])) pixel[c] = 0.0f;
    warnings.add({file.string(), "", "holds negative light (" + std::to_string(negative) + " pixel(s))",
                  "negative components are read as 0"});
  }
  if (not_numbers + infinite == 0) return;
  for (glm::vec3& pixel : image.pixels())
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(pixel[c])) pixel[c] = pixel[c] > 0.0f ? largest : 0.0f;
  warnings.add(
      {file.string(), "",
       "pixels hold NaN (" + std::to_string(not_numbers) + ") or infinity (" + std::to_string(infinite) + ")",
       "NaN is read as 0, infinity as the largest finite value, " + decimal(largest)});
}

void warn_of_shape(const std::filesystem::path& file, const glm::ivec2& size, Warnings& warnings) {
  constexpr int kTolerance = 10;  // a tenth of the width
  if (std::abs(size.x - 2 * size.y) <= size.x / kTolerance) return;
  warnings.add({file.string(), "",
                "is " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                    " pixels, and a picture in latitude and longitude is twice as wide as high",
                "it is stretched over all directions"});
}

}  // namespace

Expected<std::shared_ptr<const Environment>> load_environment(const std::filesystem::path& path,
                                                              Progress* progress, std::uint64_t limit_bytes,
                                                              Warnings* warnings) {
  if (path == "studio") return studio_sky();
  MemoryLimit limit(limit_bytes);
  Expected<Image<glm::vec3>> image = read_environment(path, progress, limit);
  if (!image) return Unexpected(image.error());
  Warnings unheard;
  repair(path, *image, warnings ? *warnings : unheard);
  warn_of_shape(path, image->size(), warnings ? *warnings : unheard);
  return std::make_shared<const Environment>(std::move(*image), path.string());
}

}  // namespace pinocchio
