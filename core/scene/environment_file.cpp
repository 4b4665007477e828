#include <ImfChannelList.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "core/image/exr_open.h"
#include "core/scene/cube_map.h"
#include "core/scene/input_file.h"
#include "core/scene/memory_limit.h"
#include "core/scene/radiance.h"
#include "pinocchio/environment.h"
#include "pinocchio/load.h"

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

// Luminance Y with chroma RY and BY, of which there is one for four pixels.
bool is_luminance_chroma(const Imf::ChannelList& list) {
  const bool has_rgb = list.findChannel("R") && list.findChannel("G") && list.findChannel("B");
  return !has_rgb && list.findChannel("Y") && (list.findChannel("RY") || list.findChannel("BY"));
}

void read_channels(Imf::InputFile& in, const std::array<std::string, 3>& channels, Image<glm::vec3>& image) {
  const Imath::Box2i& data = in.header().dataWindow();
  const std::size_t row = static_cast<std::size_t>(image.width()) * sizeof(glm::vec3);
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
}

// OpenEXR makes colour of luminance and chroma.
void read_luminance_chroma(const std::filesystem::path& file, Image<glm::vec3>& image) {
  Imf::RgbaInputFile in(file.c_str());
  const Imath::Box2i& data = in.dataWindow();
  std::vector<Imf::Rgba> line(static_cast<std::size_t>(image.width()));
  const auto first = reinterpret_cast<std::uintptr_t>(line.data()) -
                     static_cast<std::uintptr_t>(std::int64_t{data.min.x} * std::int64_t{sizeof(Imf::Rgba)});
  in.setFrameBuffer(reinterpret_cast<Imf::Rgba*>(first), 1, 0);
  for (int y = 0; y < image.height(); ++y) {
    in.readPixels(data.min.y + y);
    std::ranges::transform(line, &image.at(0, y),
                           [](const Imf::Rgba& p) { return glm::vec3(p.r, p.g, p.b); });
  }
}

// Six faces, one above another, as OpenEXR has them: their outer pixels lie on the cube's edges, so nothing
// is interpolated across those.
Image<glm::vec3> lat_long_of_faces(const Image<glm::vec3>& faces) {
  const Imath::Box2i window({0, 0}, {faces.width() - 1, faces.height() - 1});
  const int last = faces.width() - 1;
  return lat_long_of(faces.width(), [&](const glm::vec3& direction) {
    Imf::CubeMapFace face{};
    Imath::V2f at;
    Imf::CubeMap::faceAndPixelPosition({direction.x, direction.y, direction.z}, window, face, at);
    const auto texel = [&](int x, int y) -> const glm::vec3& {
      const Imath::V2f place(static_cast<float>(std::clamp(x, 0, last)),
                             static_cast<float>(std::clamp(y, 0, last)));
      const Imath::V2f pixel = Imf::CubeMap::pixelPosition(face, window, place);
      return faces.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    };
    const glm::ivec2 low(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
    const glm::vec2 f = glm::vec2(at.x, at.y) - glm::vec2(low);
    return glm::mix(glm::mix(texel(low.x, low.y), texel(low.x + 1, low.y), f.x),
                    glm::mix(texel(low.x, low.y + 1), texel(low.x + 1, low.y + 1), f.x), f.y);
  });
}

Expected<Image<glm::vec3>> read_exr_environment(const std::filesystem::path& file, MemoryLimit& limit) try {
  const std::unique_ptr<Imf::InputFile> opened = open_exr(file, std::min(kUsualExrClaim, limit.bytes()));
  Imf::InputFile& in = *opened;
  const std::array<std::string, 3> channels = color_channels(in.header().channels());
  const bool chroma = is_luminance_chroma(in.header().channels());
  if (channels[0].empty() && !chroma)
    return refuse(file, "has no channels R, G and B, nor Y", "write it as an RGB picture");
  const Imath::Box2i& data = in.header().dataWindow();
  const std::uint64_t width = static_cast<std::uint64_t>(std::int64_t{data.max.x} - data.min.x + 1),
                      height = static_cast<std::uint64_t>(std::int64_t{data.max.y} - data.min.y + 1);
  constexpr std::uint64_t kMostSide = 1 << 20;
  if (width > kMostSide || height > kMostSide)
    return refuse(file, "has no size that can be", "is it damaged?");
  const bool is_cube = Imf::hasEnvmap(in.header()) && Imf::envmap(in.header()) == Imf::ENVMAP_CUBE;
  if (is_cube && height != 6 * width)
    return refuse(file, "is a cube map (envmap) whose faces are not six squares, one above another",
                  "write it in latitude and longitude");
  // Picture and sums of light, of which the latter are made later.
  const std::uint64_t pixels = is_cube ? width * height + 8 * width * width : width * height;
  if (!limit.take(file.string(), "the environment", pixels, sizeof(glm::vec3) + sizeof(float)))
    return Unexpected(*limit.error());
  Image<glm::vec3> image(glm::ivec2(width, height));
  if (chroma)
    read_luminance_chroma(file, image);
  else
    read_channels(in, channels, image);
  if (is_cube) return lat_long_of_faces(image);
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

// What is no finite number would leave blotches, black ones where the sun is.
void repair(const std::filesystem::path& file, Image<glm::vec3>& image, Warnings& warnings) {
  float largest = 0.0f;
  std::size_t not_numbers = 0, infinite = 0;
  for (const glm::vec3& pixel : image.pixels()) {
    bool is_infinite = false, is_nan = false;
    for (int c = 0; c < 3; ++c) {
      is_nan |= std::isnan(pixel[c]);
      is_infinite |= std::isinf(pixel[c]);
      if (std::isfinite(pixel[c])) largest = std::max(largest, pixel[c]);
    }
    not_numbers += is_nan ? 1 : 0;
    infinite += is_infinite ? 1 : 0;
  }
  if (not_numbers + infinite == 0) return;
  for (glm::vec3& pixel : image.pixels())
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(pixel[c])) pixel[c] = pixel[c] > 0.0f ? largest : 0.0f;
  std::array<char, 32> value{};
  const char* const end =
      std::to_chars(value.data(), value.data() + value.size(), largest, std::chars_format::general, 6).ptr;
  const std::string most(static_cast<const char*>(value.data()), end);
  warnings.add(
      {file.string(), "",
       "pixels hold NaN (" + std::to_string(not_numbers) + ") or infinity (" + std::to_string(infinite) + ")",
       "NaN is read as 0, infinity as the largest finite value, " + most});
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
  MemoryLimit limit(limit_bytes);
  Expected<Image<glm::vec3>> image = read_environment(path, progress, limit);
  if (!image) return Unexpected(image.error());
  Warnings unheard;
  repair(path, *image, warnings ? *warnings : unheard);
  warn_of_shape(path, image->size(), warnings ? *warnings : unheard);
  return std::make_shared<const Environment>(std::move(*image), path.string());
}

}  // namespace pinocchio
