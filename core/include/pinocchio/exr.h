#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "pinocchio/error.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/pixel_box.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// One channel of an EXR: a value for each pixel of the data window, row by row from the top. Halves are held
// as floats and rounded when they are written; finite values stay finite (clamped to 65504).
struct ExrChannel {
  enum class Type { half, real, uint };

  std::string name;
  Type type = Type::half;
  std::vector<float> values;         // half, real
  std::vector<std::uint32_t> uints;  // uint
};

// The packing of pixels. All methods are lossless.
enum class ExrCompression {
  zip,   // deflate, 16 lines at a time: the default of OpenEXR and of the programs that read it
  zips,  // deflate, line by line: for programs that read few lines at a time
  piz,   // wavelets: smaller for grainy pictures
  rle,   // run lengths: fast
  none,
};
inline constexpr std::array<std::string_view, 5> kExrCompressionNames{"zip", "zips", "piz", "rle", "none"};

struct ExrRational {
  int numerator = 0;
  int denominator = 1;

  friend bool operator==(const ExrRational&, const ExrRational&) = default;
};

using ExrAttribute = std::variant<std::string, float, glm::mat4, int, ExrRational>;

struct ExrFile {
  glm::ivec2 display_size{0, 0};  // displayWindow: from (0, 0) to this
  PixelBox data_window;           // the pixels in the file
  std::vector<ExrChannel> channels;
  // Matrices are for column vectors, as in GLM. The file holds their transpose, for OpenEXR's row vectors.
  std::map<std::string, ExrAttribute> attributes;
  ExrCompression compression = ExrCompression::zip;
  bool reproducible = true;  // the same bytes on every machine; else ZIP and ZIPS are faster

  [[nodiscard]] const ExrChannel* find(const std::string& name) const;
};

// Writes one part with scan lines and Rec. 709 chromaticities, whole or not at all. Throws EnvironmentError
// where it cannot be written. Reading and writing different files on many threads is safe. Phase "write".
void write_exr(const std::filesystem::path& file, const ExrFile& exr, Progress* progress = nullptr);

// Reads any single-part EXR without subsampled channels. Errors name the file and what is wrong.
[[nodiscard]] Expected<ExrFile> read_exr(const std::filesystem::path& file);

}  // namespace pinocchio
