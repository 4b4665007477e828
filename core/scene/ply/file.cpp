#include "core/scene/ply/file.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/base/decimal.h"
#include "core/files/text_lines.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

template <class T>
double read(const char* at, bool swapped) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, at, sizeof(T));
  if (swapped) std::reverse(std::begin(bytes), std::end(bytes));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return as_double(value);
}

// In the order of PlyType.
struct TypeRow {
  std::string_view name, other_name;
  std::size_t size;
  double (*read)(const char* at, bool swapped);
};
template <class T>
constexpr TypeRow type_row(std::string_view name, std::string_view other_name) {
  return {name, other_name, sizeof(T), read<T>};
}
constexpr TypeRow kPlyTypes[] = {
    type_row<std::int8_t>("char", "int8"),    type_row<std::uint8_t>("uchar", "uint8"),
    type_row<std::int16_t>("short", "int16"), type_row<std::uint16_t>("ushort", "uint16"),
    type_row<std::int32_t>("int", "int32"),   type_row<std::uint32_t>("uint", "uint32"),
    type_row<float>("float", "float32"),      type_row<double>("double", "float64"),
};

const TypeRow& type_row(PlyType type) {
  return kPlyTypes[as_size(type)];
}

std::optional<PlyType> type_of(std::string_view name) {
  for (const TypeRow& row : kPlyTypes)
    if (row.name == name || row.other_name == name) return static_cast<PlyType>(&row - kPlyTypes);
  return std::nullopt;
}

}  // namespace

Unexpected PlyFile::error(const std::string& what) const {
  return Unexpected(
      InputError{path_.string(), format_ == Format::ascii ? line_ : 0, what, "export the file again"});
}

Expected<PlyFile> PlyFile::open(const std::filesystem::path& path, FileBytes bytes) {
  PlyFile file;
  file.path_ = path;
  file.bytes_ = std::move(bytes);
  if (const Expected<void> read = file.read_header(); !read) return Unexpected(read.error());
  return file;
}

Expected<void> PlyFile::read_header() {
  const std::string_view text = bytes_.text();
  if (!text.starts_with("ply")) return error("is not PLY: it does not begin with the word ply");
  for (bool ended = false; !ended;) {
    const std::size_t end = text.find_first_of("\r\n", at_);
    if (end == std::string::npos) return error("its header does not end (end_header)");
    const std::string_view line = text.substr(at_, end - at_);
    at_ = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    if (const Expected<void> read = read_header_line(line, ended); !read) return read;
    ++line_;
  }
  if (!format_known_) return error("its header has no format");
  if (format_ != Format::ascii && is_text()) return error("its header says binary, its data is text");
  std::size_t least = 0;  // bytes that the rows take
  for (const PlyElement& element : elements_) {
    std::size_t row = 0;
    for (const PlyProperty& p : element.properties)
      row += format_ == Format::ascii ? 2 : type_row(p.is_list ? p.count_type : p.type).size;
    if (row > 0 && element.count > (text.size() + 1 - at_ - std::min(least, text.size() - at_)) / row)
      return error("its header promises " + std::to_string(element.count) + " of element " + element.name +
                   ", the file is too short for them");
    least += row * element.count;
  }
  return {};
}

Expected<void> PlyFile::read_header_line(std::string_view line, bool& ended) {
  const std::string_view word = next_word(line);
  if (word == "end_header") {
    ended = true;
  } else if (word == "format") {
    const std::string_view name = next_word(line);
    format_known_ = true;
    if (name == "ascii")
      format_ = Format::ascii;
    else if (name == "binary_little_endian")
      format_ = Format::little;
    else if (name == "binary_big_endian")
      format_ = Format::big;
    else
      return error("its format '" + std::string(name) + "' is not known");
  } else if (word == "element") {
    PlyElement element;
    element.name = next_word(line);
    if (std::ranges::find(elements_, element.name, &PlyElement::name) != elements_.end())
      return error("its header has two elements called " + element.name);
    const std::string_view count = next_word(line);
    const auto [end, failure] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (failure != std::errc() || end != count.data() + count.size() || element.count > 0xffffffffu)
      return error("element " + element.name + " has '" + std::string(count) +
                   "' where its number is expected");
    elements_.push_back(std::move(element));
  } else if (word == "property") {
    PlyProperty property;
    std::string_view type = next_word(line);
    property.is_list = type == "list";
    if (property.is_list) {
      const std::optional<PlyType> count_type = type_of(next_word(line));
      if (!count_type) return error("a list's length has a type that PLY does not know");
      property.count_type = *count_type;
      type = next_word(line);
    }
    const std::optional<PlyType> known = type_of(type);
    property.name = next_word(line);
    if (!known || elements_.empty())
      return error("property " + property.name +
                   " belongs to no element or has a type that PLY does not know");
    property.type = *known;
    elements_.back().properties.push_back(std::move(property));
  } else if (word == "comment" && next_word(line) == "TextureFile") {
    textures_.emplace_back(trimmed(line));
  }
  return {};  // other comments, obj_info
}

std::size_t PlyFile::bytes_left() const {
  constexpr std::string_view kPadding(" \t\n\v\f\r\0\x1a", 8);
  const std::size_t last = rest().find_last_not_of(kPadding);
  return last == std::string_view::npos ? 0 : last + 1;
}

bool PlyFile::is_text() const {
  constexpr std::size_t kLeast = 16, kMost = 4096;  // bytes that are examined
  constexpr std::string_view kNumbers = "0123456789+-.eE \t\r\n";
  const std::string_view begin = rest().substr(0, kMost);
  return begin.size() >= kLeast && begin.find_first_not_of(kNumbers) == std::string_view::npos;
}

bool PlyFile::read_number(PlyType type, double& value) {
  if (format_ != Format::ascii) {
    const std::size_t size = type_row(type).size;
    if (bytes_.size() - at_ < size) return false;
    constexpr bool kLittleHere = std::endian::native == std::endian::little;
    value = type_row(type).read(bytes_.data() + at_, (format_ == Format::little) != kLittleHere);
    at_ += size;
    return true;
  }
  const std::string_view text = bytes_.text();
  while (at_ < text.size() && (text[at_] == ' ' || (text[at_] >= '\t' && text[at_] <= '\r')))
    line_ += text[at_++] == '\n' ? 1 : 0;
  if (at_ < text.size() && text[at_] == '+') ++at_;
  const auto [end, failure] = read_decimal(text.substr(at_), value);
  if (failure != std::errc()) return false;
  at_ = end - bytes_.data();
  return true;
}

Expected<void> PlyFile::read_row(const PlyElement& element, PlyRow& row) {
  row.numbers.resize(element.properties.size());
  row.lists.resize(element.properties.size());
  const auto cut = [&](const PlyProperty& p) {
    const std::string_view next = rest().substr(0, 256);
    const bool is_binary = format_ == Format::ascii && next.find('\0') != std::string_view::npos;
    return error("cannot read " + p.name + " of element " + element.name +
                 (at_ >= bytes_.size() ? ": the file ends too early"
                  : is_binary          ? ": its header says ascii, its data is binary"
                                       : ": not a number"));
  };
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& p = element.properties[i];
    if (!p.is_list) {
      if (!read_number(p.type, row.numbers[i])) return cut(p);
      continue;
    }
    double count = 0.0;
    if (!read_number(p.count_type, count)) return cut(p);
    const std::size_t left = (bytes_.size() - at_) / (format_ == Format::ascii ? 1 : type_row(p.type).size);
    if (!(count >= 0.0 && count <= left) || count != std::floor(count))
      return error("cannot read " + p.name + " of element " + element.name + ": a list of " +
                   shortest(count) + " does not fit the file");
    row.lists[i].resize(as_size(count));
    for (double& value : row.lists[i])
      if (!read_number(p.type, value)) return cut(p);
  }
  return {};
}

}  // namespace pinocchio
