#include "core/scene/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/decimal.h"
#include "core/scene/text_lines.h"

namespace pinocchio {
namespace {

std::optional<float> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  float value = 0.0f;
  const auto [end, failure] = read_decimal(word, value);
  if (failure != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Cuts up to three numbers off the line; how many there were.
int cut_numbers(std::string_view& line, std::array<float, 3>& to) {
  for (int i = 0; i < 3; ++i) {
    std::string_view rest = line;
    const std::optional<float> value = number(next_word(rest));
    if (!value) return i;
    to[static_cast<std::size_t>(i)] = *value;
    line = rest;
  }
  return 3;
}

// One number stands for all three.
glm::vec3 color(std::string_view line) {
  std::array<float, 3> rgb{};
  const int count = cut_numbers(line, rgb);
  if (count == 1) rgb[1] = rgb[2] = rgb[0];
  return {rgb[0], rgb[1], rgb[2]};
}

// Options that take numbers, and those that take a word.
constexpr std::array<std::string_view, 7> kNumbers{"-s", "-o", "-bm", "-t", "-mm", "-texres", "-boost"};
constexpr std::array<std::string_view, 6> kWords{"-clamp", "-imfchan", "-blendu", "-blendv", "-cc", "-type"};

template <std::size_t n>
bool is_one_of(std::string_view word, const std::array<std::string_view, n>& of) {
  return std::find(of.begin(), of.end(), word) != of.end();
}

// The options, then the file's name: the rest of the line, spaces and all.
MtlTexture texture(std::string_view line) {
  MtlTexture t;
  for (;;) {
    std::string_view rest = line;
    const std::string_view option = next_word(rest);
    if (is_one_of(option, kNumbers)) {
      std::array<float, 3> values{};
      const int count = cut_numbers(rest, values);
      const glm::vec2 two(values[0], values[1]);
      if (option == "-s" && count > 0) t.scale = count == 1 ? glm::vec2(two.x, 1.0f) : two;
      if (option == "-o" && count > 0) t.offset = two;
      if (option == "-bm" && count > 0) t.bump = two.x;
    } else if (is_one_of(option, kWords)) {
      const std::string_view value = next_word(rest);
      if (option == "-clamp") t.clamp = value == "on";
      if (option == "-imfchan" && value.size() == 1) t.channel = value.front();
    } else {
      break;
    }
    line = rest;
  }
  t.file = trimmed(line);
  if (t.file.size() > 1 && t.file.front() == '"' && t.file.back() == '"')
    t.file = t.file.substr(1, t.file.size() - 2);
  std::replace(t.file.begin(), t.file.end(), '\\', '/');  // from Windows
  return t;
}

float number_or(std::string_view line, float otherwise) {
  std::array<float, 3> values{};
  return cut_numbers(line, values) > 0 ? values[0] : otherwise;
}

class MtlReader {
 public:
  void read(std::string_view keyword, std::string_view line) {
    if (keyword == "newmtl") {
      all_.emplace_back().name = trimmed(line);
      has_d_ = false;
    } else if (!all_.empty() && !read_texture(all_.back(), keyword, line)) {
      read_value(all_.back(), keyword, line);
    }
  }
  std::vector<MtlMaterial> take() { return std::move(all_); }

 private:
  static bool read_texture(MtlMaterial& m, std::string_view keyword, std::string_view line) {
    MtlTexture* const to = keyword == "map_Kd"                                                   ? &m.map_kd
                           : keyword == "map_d"                                                  ? &m.map_d
                           : keyword == "map_Ke"                                                 ? &m.map_ke
                           : keyword == "map_Bump" || keyword == "map_bump" || keyword == "bump" ? &m.map_bump
                           : keyword == "norm" || keyword == "map_Kn"                            ? &m.norm
                                                                                                 : nullptr;
    if (to) *to = texture(line);
    return to != nullptr;
  }

  void read_value(MtlMaterial& m, std::string_view keyword, std::string_view line) {
    if (keyword == "Ka") m.ka = color(line);
    if (keyword == "Kd") m.kd = color(line);
    if (keyword == "Ks") m.ks = color(line);
    if (keyword == "Ke") m.ke = color(line);
    if (keyword == "Tf" || keyword == "Kt") m.tf = color(line);
    if (keyword == "Ns") m.ns = number_or(line, m.ns);
    if (keyword == "Ni") m.ni = number_or(line, m.ni);
    if (keyword == "illum") m.illum = static_cast<int>(std::clamp(number_or(line, 0.0f), 0.0f, 10.0f));
    if (keyword == "Pm") m.metallic = std::clamp(number_or(line, 0.0f), 0.0f, 1.0f);
    if (keyword == "Pr") m.roughness = std::clamp(number_or(line, 0.5f), 0.0f, 1.0f);
    if (keyword == "d") {
      std::string_view rest = line;
      m.dissolve = std::clamp(number_or(next_word(rest) == "-halo" ? rest : line, 1.0f), 0.0f, 1.0f);
      has_d_ = true;
    }
    if (keyword == "Tr" && !has_d_) m.dissolve = 1.0f - std::clamp(number_or(line, 0.0f), 0.0f, 1.0f);
  }

  std::vector<MtlMaterial> all_;
  bool has_d_ = false;  // which is asked before Tr, its opposite
};

}  // namespace

std::vector<MtlMaterial> read_mtl(std::string_view text) {
  MtlReader reader;
  for (TextLines lines(text); lines.next();) {
    std::string_view line = lines.line();
    const std::string_view keyword = next_word(line);
    reader.read(keyword, line);
  }
  return reader.take();
}

bool reads_mtl_option(std::string_view option) {
  constexpr std::array<std::string_view, 5> kRead{"-s", "-o", "-clamp", "-bm", "-imfchan"};
  return is_one_of(option, kRead);
}

}  // namespace pinocchio
