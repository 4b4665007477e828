#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "core/image/exr_open.h"
#include "core/scene/input_file.h"
#include "core/scene/memory_limit.h"
#include "core/scene/radiance.h"
#include "pinocchio/environment.h"

namespace pinocchio {
namespace {

Unexpected refuse(const std::filesystem::path& file, const std::string& what, const std::string& remedy) {
  return Unexpected(InputError{file.string(), 0, what, remedy});
}

// Where a colour's channels are: R, G and B, or Y three times; empty: they are not there.
std::array<std::string, 3> color_channels(const Imf::ChannelList& list) {
  const auto there = [&list](const char* name) {
    const Imf::Channel* const channel = list.findChannel(name);
    return channel && channel->xSampling == 1 && channel->ySampling == 1;
  };
  if (there("R") && there("G") && there("B")) return {"R", "G", "B"};
  if (there("Y")) return {"Y", "Y", "Y"};
  return {};
}

Expected<Image<glm::vec3>> read_exr_environment(const std::filesystem::path& file, MemoryLimit& limit) try {
  const std::unique_ptr<Imf::InputFile> opened = open_exr(file, std::min(kUsualExrClaim, limit.bytes()));
  Imf::InputFile& in = *opened;
  const std::array<std::string, 3> channels = color_channels(in.header().channels());
  if (channels[0].empty())
    return refuse(file, "has no channels R, G and B, nor Y", "write it as an RGB picture");
  const Imath::Box2i& data = in.header().dataWindow();
  const std::uint64_t width = static_cast<std::uint64_t>(std::int64_t{data.max.x} - data.min.x + 1),
                      height = static_cast<std::uint64_t>(std::int64_t{data.max.y} - data.min.y + 1);
  constexpr std::uint64_t kMostSide = 1 << 20;
  if (width > kMostSide || height > kMostSide)
    return refuse(file, "has no size that can be", "is it damaged?");
  // Picture and sums of light, of which the latter are made later.
  if (!limit.take(file.string(), "the environment", width * height, sizeof(glm::vec3) + sizeof(float)))
    return Unexpected(*limit.error());
  Image<glm::vec3> image(glm::ivec2(width, height));
  const std::size_t row = width * sizeof(glm::vec3);
  const auto first = reinterpret_cast<std::uintptr_t>(image.pixels().data()) -
                     static_cast<std::uintptr_t>(std::int64_t{data.min.y} * static_cast<std::int64_t>(row) +
                                                 std::int64_t{data.min.x} * std::int64_t{sizeof(glm::vec3)});
  Imf::FrameBuffer pixels;
  for (std::size_t c = 0; c < 3 && (c == 0 || channels[c] != channels[0]); ++c)
    pixels.insert(channels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first + c * sizeof(float)),
                                          sizeof(glm::vec3), row));
  in.setFrameBuffer(pixels);
  in.readPixels(data.min.y, data.max.y);
  if (channels[1] == channels[0])
    for (glm::vec3& c : image.pixels()) c = glm::vec3(c.x);
  return image;
} catch (const std::exception& error) {
  return refuse(file, std::string("cannot be read as EXR: ") + error.what(), "is it damaged?");
}

Expected<Image<glm::vec3>> read_environment(const std::filesystem::path& file, Progress* progress,
                                            MemoryLimit& limit) {
  const Expected<FileBytes> bytes = read_input_file(file, progress);
  if (!bytes) return Unexpected(bytes.error());
  if (bytes->text().starts_with("\x76\x2f\x31\x01")) return read_exr_environment(file, limit);
  if (bytes->text().starts_with("#?")) return decode_radiance(file.string(), bytes->unsigned_bytes(), limit);
  return refuse(file, "is neither EXR nor Radiance (.hdr)",
                "an environment is a picture of all directions in latitude and longitude");
}

}  // namespace

Expected<std::shared_ptr<const Environment>> load_environment(const std::filesystem::path& path,
                                                              Progress* progress, std::uint64_t limit_bytes) {
  MemoryLimit limit(limit_bytes);
  Expected<Image<glm::vec3>> image = read_environment(path, progress, limit);
  if (!image) return Unexpected(image.error());
  return std::make_shared<const Environment>(std::move(*image), path.string());
}

}  // namespace pinocchio
