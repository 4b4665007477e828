// PLY (Turk 1994), ascii and binary, as rows of numbers. Debian 12 packages no library for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/file_bytes.h"
#include "pinocchio/error.h"

namespace pinocchio {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32, count_type = PlyType::uint8;
  bool is_list = false;

  // The factor that scales a colour of this type to 0 to 1. Whole numbers other than `ushort` are 0 to 255.
  [[nodiscard]] float color_scale() const {
    if (type == PlyType::float32 || type == PlyType::float64) return 1.0f;
    return type == PlyType::uint16 ? 1.0f / 65535.0f : 1.0f / 255.0f;
  }
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

// The values of all properties, each a number or a list.
struct PlyRow {
  std::vector<double> numbers;
  std::vector<std::vector<double>> lists;
};

class PlyFile {
 public:
  // Reads the header. One that states more rows than the file can hold is an error.
  [[nodiscard]] static Expected<PlyFile> open(const std::filesystem::path& path, FileBytes bytes);

  [[nodiscard]] const std::vector<PlyElement>& elements() const { return elements_; }
  // The names in MeshLab's comments "TextureFile name".
  [[nodiscard]] const std::vector<std::string>& textures() const { return textures_; }
  // The next row, in the file's order: all rows of an element, then the next element's.
  [[nodiscard]] Expected<void> read_row(const PlyElement& element, PlyRow& row);
  // The position of the next row in the file.
  struct Place {
    std::size_t at;
    int line;
  };
  [[nodiscard]] Place place() const { return {at_, line_}; }
  void go_to(const Place& place) {
    at_ = place.at;
    line_ = place.line;
  }
  // Bytes after the last row that has been read, without blanks and zeros at the file's end.
  [[nodiscard]] std::size_t bytes_left() const;
  [[nodiscard]] Unexpected error(const std::string& what) const;

 private:
  enum class Format : std::uint8_t { ascii, little, big };

  Expected<void> read_header();
  Expected<void> read_header_line(std::string_view line, bool& ended);
  // Whether the data after the header is text, whatever the header states.
  [[nodiscard]] bool is_text() const;
  [[nodiscard]] std::string_view rest() const { return bytes_.text().substr(at_); }
  // False: the end of the file, or an ascii word that is no number.
  bool read_number(PlyType type, double& value);

  std::filesystem::path path_;
  FileBytes bytes_;
  std::size_t at_ = 0;
  int line_ = 1;
  Format format_ = Format::ascii;
  bool format_known_ = false;
  std::vector<PlyElement> elements_;
  std::vector<std::string> textures_;
};

}  // namespace pinocchio
