#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "pinocchio/image.h"

namespace pinocchio {

// A PNG file's bytes. Throws EnvironmentError.
[[nodiscard]] std::string encode_png(const Image<glm::u8vec3>& pixels);
[[nodiscard]] std::string encode_png(const Image<glm::u8vec4>& pixels);

// Writes the file whole or not at all. `text`, in ASCII, goes into a text chunk with the keyword "pinocchio";
// if it is empty, there is no such chunk. Throws EnvironmentError.
void write_png(const std::filesystem::path& file, const Image<glm::u8vec3>& pixels,
               const std::string& text = {});
// The same with alpha, which is not multiplied into the colour.
void write_png(const std::filesystem::path& file, const Image<glm::u8vec4>& pixels,
               const std::string& text = {});

// The text that the file was written with; none where the file cannot be decoded to its end.
[[nodiscard]] std::optional<std::string> text_of_png(const std::filesystem::path& file);

}  // namespace pinocchio
