#include "python/src/png.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pinocchio/conversion.h"

namespace pinocchio::python {
namespace {

// IEC 61966-2-1
std::uint8_t srgb8(float linear) {
  const float c = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;  // NaN is 0
  const float srgb = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(255.0f * srgb + 0.5f);
}

void add_number(std::string& to, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<char>(number >> shift & 0xff));
}

void add_chunk(std::string& to, const std::string& body,
               const nb::module_& zlib) {  // its type, then its data
  add_number(to, as_uint32(body.size() - 4));
  to += body;
  add_number(to, nb::cast<std::uint32_t>(zlib.attr("crc32")(nb::bytes(body.data(), body.size()))));
}

// A pixel on its way to sRGB.
glm::vec4 shown(const glm::vec4& pixel, float factor, const Background& background, bool opaque) {
  if (background.kind != Background::Kind::color) {
    const float alpha =
        opaque ? 1.0f : std::clamp(pixel.a, 0.0f, 1.0f);  // the colour is multiplied by it already
    return alpha > 0.0f ? glm::vec4(factor / alpha * glm::vec3(pixel), alpha) : glm::vec4(0.0f);
  }
  const float alpha = std::clamp(pixel.a, 0.0f, 1.0f);
  const glm::vec3 behind = (1.0f - alpha) * background.color;
  if (alpha == 0.0f) return glm::vec4(behind, 1.0f);
  const glm::vec3 own = factor / alpha * glm::max(glm::vec3(pixel) - behind, 0.0f);
  return glm::vec4(behind + alpha * glm::min(own, 1.0f), 1.0f);
}

}  // namespace

nb::bytes png_of(const FrameResult& frame, float exposure) {
  if (!std::isfinite(exposure)) throw Error("exposure is not a finite number");
  const float factor = std::exp2(exposure);
  const Image<glm::vec4>& color = frame.color;
  const Background& background = frame.settings.background.value;
  const bool opaque = backdrop_of(frame.scene, background).picture != nullptr;
  std::string rows;
  rows.reserve(color.pixels().size() * 4 + as_size(color.height()));
  for (int y = 0; y < color.height(); ++y) {
    rows.push_back(0);  // no filter
    for (int x = 0; x < color.width(); ++x) {
      const glm::vec4 pixel = shown(color.at(x, y), factor, background, opaque);
      for (int c = 0; c < 3; ++c) rows.push_back(static_cast<char>(srgb8(pixel[c])));
      rows.push_back(static_cast<char>(static_cast<std::uint8_t>(255.0f * pixel.a + 0.5f)));
    }
  }
  const nb::module_ zlib = nb::module_::import_("zlib");
  const nb::bytes packed = nb::cast<nb::bytes>(zlib.attr("compress")(nb::bytes(rows.data(), rows.size())));
  std::string header = "IHDR", file = "\x89PNG\r\n\x1a\n";
  add_number(header, as_uint32(color.width()));
  add_number(header, as_uint32(color.height()));
  header += std::string("\x08\x06\0\0\0", 5);  // 8 bits, RGBA
  add_chunk(file, header, zlib);
  add_chunk(file, std::string("sRGB\0", 5), zlib);
  add_chunk(file, "IDAT" + std::string(packed.c_str(), packed.size()), zlib);
  add_chunk(file, "IEND", zlib);
  return nb::bytes(file.data(), file.size());
}

void write_bytes(const std::filesystem::path& path, const nb::bytes& bytes) {
  const std::filesystem::path part = path.string() + ".part" + std::to_string(getpid());
  const auto failed = [&](const char* why) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    return Error(path.string() + ": cannot be written: " + why + "; check the folder and the disk");
  };
  std::FILE* const file = std::fopen(part.c_str(), "wb");
  if (!file) throw failed(std::strerror(errno));
  const bool is_whole = std::fwrite(bytes.c_str(), 1, bytes.size(), file) == bytes.size();
  if (std::fclose(file) != 0 || !is_whole) throw failed(std::strerror(errno));
  if (std::rename(part.c_str(), path.c_str()) != 0) throw failed(std::strerror(errno));
}

}  // namespace pinocchio::python
