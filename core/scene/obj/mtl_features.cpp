#include "core/scene/obj/mtl_features.h"

#include <algorithm>
#include <string>

#include "core/files/text_lines.h"
#include "core/scene/obj/mtl.h"

namespace pinocchio {
namespace {

// A statement's keyword and what the picture loses without it; empty: it is read.
struct Statement {
  std::string_view keyword, lost;
};

constexpr std::string_view kGlossy = "highlights and mirrors are as Ks and Ns say";
constexpr std::string_view kSmooth = "the surface looks smooth";

constexpr Statement kStatements[] = {
    {"Ka", ""},
    {"Kd", ""},
    {"Ks", ""},
    {"Ke", ""},
    {"Ns", ""},
    {"Ni", ""},
    {"Tf", ""},
    {"Kt", ""},
    {"d", ""},
    {"Tr", ""},
    {"illum", ""},
    {"map_Kd", ""},
    {"map_Ka", ""},  // exporters repeat map_Kd, which ambient light uses
    {"sharpness", ""},
    {"map_aat", ""},
    {"map_Ks", "highlights have one colour"},
    {"map_Ns", "highlights are equally sharp everywhere"},
    {"map_d", ""},
    {"map_Tr", "its holes are filled"},
    {"map_Ke", ""},
    {"map_Bump", ""},
    {"map_bump", ""},
    {"bump", ""},
    {"norm", ""},
    {"disp", kSmooth},
    {"map_disp", kSmooth},
    {"map_Disp", kSmooth},
    {"decal", "it is not painted on"},
    {"refl", "its picture is not mirrored"},
    {"Pr", ""},
    {"Pm", ""},
    {"map_Pr", kGlossy},
    {"map_Pm", kGlossy},
    {"Ps", "the sheen of cloth is missing"},
    {"map_Ps", "the sheen of cloth is missing"},
    {"Pc", "highlights of the clear coat are missing"},
    {"Pcr", "highlights of the clear coat are missing"},
    {"aniso", "highlights are round"},
    {"anisor", "highlights are round"},
};

bool is_texture(std::string_view keyword) {
  return keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" || keyword == "refl";
}

bool is_number(std::string_view word) {
  return word.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
}

// A number, or an option such as -halo before one.
bool is_value(std::string_view word) {
  return !word.empty() && (is_number(word) || (word.size() > 1 && word.front() == '-'));
}

}  // namespace

void add_lost_mtl_features(const std::filesystem::path& file, std::string_view text, Warnings& warnings) {
  for (TextLines lines(text); lines.next();) {
    std::string_view line = lines.line();
    const std::string_view keyword = next_word(line);
    if (keyword.empty() || keyword.front() == '#' || keyword == "newmtl") continue;
    const std::string where = "line " + std::to_string(lines.number());
    const auto* known = std::find_if(std::begin(kStatements), std::end(kStatements),
                                     [keyword](const Statement& s) { return s.keyword == keyword; });
    if (known == std::end(kStatements)) {
      warnings.add({file.string(), where + " (" + std::string(keyword.substr(0, 20)) + ")",
                    "statements that are not known are left out", "what they stand for is missing"});
    } else if (!known->lost.empty()) {
      warnings.add({file.string(), where, std::string(keyword) + " is left out", std::string(known->lost)});
    } else if (is_texture(keyword)) {
      for (std::string_view word; (word = next_word(line)).starts_with('-') && !is_number(word);) {
        if (!reads_mtl_option(word))
          warnings.add({file.string(), where, "a texture's option " + std::string(word) + " is left out",
                        "the texture lies or looks as without it"});
        std::string_view rest = line;  // its values: numbers, or on and off
        while (is_number(word = next_word(rest)) && !word.empty()) line = rest;
        if (word == "on" || word == "off" || word.size() == 1) line = rest;
      }
    } else if (const std::string_view value = next_word(line); value == "spectral" || value == "xyz") {
      warnings.add(
          {file.string(), where, "a colour as '" + std::string(value) + "' is left out", "it is black"});
    } else if (!is_value(value)) {
      warnings.add({file.string(), where,
                    std::string(keyword) + " '" + std::string(value.substr(0, 20)) + "' is no number",
                    keyword.starts_with('K') ? "it is black" : "it is 0"});
    }
  }
}

}  // namespace pinocchio
