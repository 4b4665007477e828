#include "core/scene/obj/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/decimal.h"
#include "core/files/text_lines.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

std::optional<float> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  float value = 0.0f;
  const auto [end, failure] = read_decimal(word, value);
  if (failure != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Cuts up to `most` numbers off the line; returns how many there were.
int cut_numbers(std::string_view& line, std::array<float, 3>& to, int most = 3) {
  for (int i = 0; i < most; ++i) {
    std::string_view rest = line;
    const std::optional<float> value = number(next_word(rest));
    if (!value) return i;
    to[i] = *value;
    line = rest;
  }
  return most;
}

// One number sets all three.
glm::vec3 color(std::string_view line) {
  std::array<float, 3> rgb{};
  const int count = cut_numbers(line, rgb);
  if (count == 1) rgb[1] = rgb[2] = rgb[0];
  return glm::clamp(glm::vec3(rgb[0], rgb[1], rgb[2]), 0.0f, 1e6f);
}

// Options that take numbers, and those that take a word.
constexpr std::array<std::string_view, 7> kNumbers{"-s", "-o", "-bm", "-t", "-mm", "-texres", "-boost"};
constexpr std::array<std::string_view, 6> kWords{"-clamp", "-imfchan", "-blendu", "-blendv", "-cc", "-type"};

// These take no number: one that follows is the file's name.
int most_numbers(std::string_view option) {
  if (option == "-bm" || option == "-texres" || option == "-boost") return 1;
  return option == "-mm" ? 2 : 3;
}

template <std::size_t n>
bool is_one_of(std::string_view word, const std::array<std::string_view, n>& of) {
  return std::find(of.begin(), of.end(), word) != of.end();
}

// The options, then the file's name: the rest of the line, with its spaces.
MtlTexture texture(std::string_view line) {
  MtlTexture t;
  for (;;) {
    std::string_view rest = line;
    const std::string_view option = next_word(rest);
    if (is_one_of(option, kNumbers)) {
      std::array<float, 3> values{};
      const int count = cut_numbers(rest, values, most_numbers(option));
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

// A material's transparency, as the file has it.
struct Dissolving {
  std::optional<float> d, tr;
};

// Refracting models transmit light by their transparency: their surfaces stay visible at 1.
bool refracts_by_tr(const MtlMaterial& m) {
  return (m.illum == 4 || m.illum == 6 || m.illum == 7) && m.ni > 1.0f;
}

// How a statement is read, and what the picture loses without it.
struct Statement {
  std::string_view keyword;
  void (*read)(std::string_view line, MtlMaterial& m, Dissolving& said) = nullptr;
  std::string_view lost{};  // empty: it is read, or has no effect on the picture
};

template <auto M>
constexpr Statement color_row(std::string_view keyword) {
  return {keyword, [](std::string_view line, MtlMaterial& m, Dissolving&) { m.*M = color(line); }};
}
template <auto M>
constexpr Statement number_row(std::string_view keyword) {
  return {keyword, [](std::string_view line, MtlMaterial& m, Dissolving&) { m.*M = number_or(line, m.*M); }};
}
template <auto M>
constexpr Statement texture_row(std::string_view keyword) {
  return {keyword, [](std::string_view line, MtlMaterial& m, Dissolving&) { m.*M = texture(line); }};
}
constexpr Statement lost_row(std::string_view keyword, std::string_view lost) {
  return {keyword, nullptr, lost};
}
float share_or(std::string_view line, float otherwise) {
  return std::clamp(number_or(line, otherwise), 0.0f, 1.0f);
}

using Mtl = MtlMaterial;
constexpr std::string_view kGlossy = "highlights and mirrors are as Ks and Ns say",
                           kSmooth = "the surface looks smooth", kSheen = "the sheen of cloth is missing",
                           kCoat = "highlights of the clear coat are missing",
                           kRound = "highlights are round";

constexpr Statement kStatements[] = {
    color_row<&Mtl::ka>("Ka"),
    color_row<&Mtl::kd>("Kd"),
    color_row<&Mtl::ks>("Ks"),
    color_row<&Mtl::ke>("Ke"),
    color_row<&Mtl::tf>("Tf"),
    color_row<&Mtl::tf>("Kt"),
    number_row<&Mtl::ns>("Ns"),
    number_row<&Mtl::ni>("Ni"),
    {"illum", [](std::string_view line, Mtl& m,
                 Dissolving&) { m.illum = as_int(std::clamp(number_or(line, 0.0f), 0.0f, 10.0f)); }},
    {"Pm", [](std::string_view line, Mtl& m, Dissolving&) { m.metallic = share_or(line, 0.0f); }},
    {"Pr", [](std::string_view line, Mtl& m, Dissolving&) { m.roughness = share_or(line, 0.5f); }},
    {"d",
     [](std::string_view line, Mtl&, Dissolving& said) {
       std::string_view rest = line;
       said.d = share_or(next_word(rest) == "-halo" ? rest : line, 1.0f);
     }},
    {"Tr", [](std::string_view line, Mtl&, Dissolving& said) { said.tr = share_or(line, 0.0f); }},
    texture_row<&Mtl::map_kd>("map_Kd"),
    texture_row<&Mtl::map_d>("map_d"),
    texture_row<&Mtl::map_ke>("map_Ke"),
    texture_row<&Mtl::map_bump>("map_Bump"),
    texture_row<&Mtl::map_bump>("map_bump"),
    texture_row<&Mtl::map_bump>("bump"),
    texture_row<&Mtl::norm>("norm"),
    texture_row<&Mtl::norm>("map_Kn"),
    {"map_Ka"},  // exporters repeat map_Kd, which ambient light uses
    {"sharpness"},
    {"map_aat"},
    lost_row("map_Ks", "highlights have one colour"),
    lost_row("map_Ns", "highlights are equally sharp everywhere"),
    lost_row("map_Tr", "its transparent parts are opaque"),
    lost_row("disp", kSmooth),
    lost_row("map_disp", kSmooth),
    lost_row("map_Disp", kSmooth),
    lost_row("decal", "it is not drawn"),
    lost_row("refl", "its reflection map is not shown"),
    lost_row("map_Pr", kGlossy),
    lost_row("map_Pm", kGlossy),
    lost_row("Ps", kSheen),
    lost_row("map_Ps", kSheen),
    lost_row("Pc", kCoat),
    lost_row("Pcr", kCoat),
    lost_row("aniso", kRound),
    lost_row("anisor", kRound),
};

const Statement* find_statement(std::string_view keyword) {
  const auto* const found = std::ranges::find(kStatements, keyword, &Statement::keyword);
  return found == std::end(kStatements) ? nullptr : found;
}

class MtlReader {
 public:
  // A comment names the program that wrote the file.
  void read_comment(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    by_meshlab_ |= lower.find("meshlab") != lower.npos || lower.find("vcglib") != lower.npos;
  }

  void read(std::string_view keyword, std::string_view line) {
    if (keyword == "newmtl") {
      all_.emplace_back().name = trimmed(line);
      dissolving_.emplace_back();
    } else if (const Statement* const known = find_statement(keyword);
               known && known->read && !all_.empty()) {
      known->read(line, all_.back(), dissolving_.back());
    }
  }
  MtlFile take() {
    MtlFile file{std::move(all_), {}};
    file.opacity_reason = opacity_reason(file.materials);
    for (std::size_t i = 0; i < file.materials.size(); ++i) {
      const Dissolving& said = dissolving_[i];
      if (said.d || said.tr)
        file.materials[i].dissolve = said.d                        ? *said.d
                                     : file.opacity_reason.empty() ? 1.0f - *said.tr
                                                                   : *said.tr;
    }
    return file;
  }

 private:
  [[nodiscard]] std::string opacity_reason(const std::vector<MtlMaterial>& materials) const {
    const auto any_tr = [this](auto fits) {
      return std::ranges::any_of(
          dissolving_, [&](const Dissolving& said) { return !said.d && said.tr && fits(*said.tr); });
    };
    if (!any_tr([](float) { return true; })) return {};
    // Newer versions of MeshLab write Tr as MTL defines it: 0 is opaque.
    const bool ones = any_tr([](float tr) { return tr == 1.0f; }),
               zeros = any_tr([](float tr) { return tr == 0.0f; });
    if (by_meshlab_) return ones || !zeros ? "its header names MeshLab, which writes opacity there" : "";
    for (std::size_t i = 0; i < materials.size(); ++i)
      if (dissolving_[i].d || dissolving_[i].tr != 1.0f || refracts_by_tr(materials[i])) return {};
    return "all of its materials are at 1 and would be invisible";
  }

  std::vector<MtlMaterial> all_;
  std::vector<Dissolving> dissolving_;  // one for each material
  bool by_meshlab_ = false;
};

}  // namespace

MtlFile read_mtl(std::string_view text) {
  MtlReader reader;
  for (TextLines lines(text); lines.next();) {
    std::string_view line = lines.line();
    if (trimmed(line).starts_with('#')) {
      reader.read_comment(line);
      continue;
    }
    const std::string_view keyword = next_word(line);
    reader.read(keyword, line);
  }
  return reader.take();
}

std::optional<std::string_view> lost_without(std::string_view keyword) {
  const Statement* const known = find_statement(keyword);
  return known ? std::optional(known->lost) : std::nullopt;
}

bool reads_mtl_option(std::string_view option) {
  constexpr std::array<std::string_view, 5> kRead{"-s", "-o", "-clamp", "-bm", "-imfchan"};
  return is_one_of(option, kRead);
}

}  // namespace pinocchio
