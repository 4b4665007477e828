#include "core/scene/obj/mtl_features.h"

#include <optional>
#include <string>

#include "core/files/text_lines.h"
#include "core/scene/obj/mtl.h"

namespace pinocchio {
namespace {

bool is_texture(std::string_view keyword) {
  return keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" || keyword == "refl";
}

bool is_number(std::string_view word) {
  return word.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
}

bool has_negative(std::string_view numbers) {
  for (std::string_view word; !(word = next_word(numbers)).empty();)
    if (is_number(word) && word.front() == '-' && word.find_first_of("123456789") != word.npos) return true;
  return false;
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
    const std::optional<std::string_view> lost = lost_without(keyword);
    if (!lost) {
      warnings.add({file.string(), where + " (" + std::string(keyword.substr(0, 20)) + ")",
                    "unknown statements are left out", "what they stand for is missing"});
    } else if (!lost->empty()) {
      warnings.add({file.string(), where, std::string(keyword) + " is left out", std::string(*lost)});
    } else if (is_texture(keyword)) {
      for (std::string_view word; (word = next_word(line)).starts_with('-') && !is_number(word);) {
        if (!reads_mtl_option(word))
          warnings.add({file.string(), where, "a texture's option " + std::string(word) + " is left out",
                        "the texture is drawn as if the option were not there"});
        std::string_view rest = line;  // its values: numbers, or on and off
        while (is_number(word = next_word(rest)) && !word.empty()) line = rest;
        if (word == "on" || word == "off" || word.size() == 1) line = rest;
      }
    } else if ((keyword.starts_with('K') || keyword == "Tf") && has_negative(line)) {
      warnings.add(
          {file.string(), where, std::string(keyword) + " is negative", "negative values are read as 0"});
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
