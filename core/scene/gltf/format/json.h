// Members of glTF's JSON: each may be missing or of any type. `object` may be null and need not be an object.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pinocchio {

// A value of the type T: float, double, bool, glm::vec2, glm::vec3, or std::size_t, which is a whole number
// of 0 or more (some exporters write 12.0). A vec3 may be one number for all three. None: it is not of that
// type.
template <class T>
[[nodiscard]] std::optional<T> value_of(const nlohmann::json& value);
template <>
std::optional<float> value_of(const nlohmann::json& value);
template <>
std::optional<double> value_of(const nlohmann::json& value);
template <>
std::optional<bool> value_of(const nlohmann::json& value);
template <>
std::optional<glm::vec2> value_of(const nlohmann::json& value);
template <>
std::optional<glm::vec3> value_of(const nlohmann::json& value);
template <>
std::optional<std::size_t> value_of(const nlohmann::json& value);
// -1: no index, which names nothing. An index that is too large for an int becomes the largest one.
[[nodiscard]] int index_of(const nlohmann::json& value);

// Null: there is no such member.
[[nodiscard]] const nlohmann::json* member(const nlohmann::json* object, const std::string& key);
template <class T>
[[nodiscard]] std::optional<T> value_member(const nlohmann::json* object, const std::string& key) {
  const nlohmann::json* const value = member(object, key);
  return value ? value_of<T>(*value) : std::nullopt;
}
[[nodiscard]] int index_member(const nlohmann::json* object, const std::string& key);
// Empty: the member is no text.
[[nodiscard]] std::string text_member(const nlohmann::json* object, const std::string& key);
// Empty: there is no such member, or it is no array.
[[nodiscard]] const nlohmann::json& array_member(const nlohmann::json* object, const std::string& key);
[[nodiscard]] std::vector<int> indices_member(const nlohmann::json* object, const std::string& key);
// An array of numbers alone; else empty.
[[nodiscard]] std::vector<double> numbers_member(const nlohmann::json* object, const std::string& key);

// An object of `object`'s extensions; null: there is none.
[[nodiscard]] const nlohmann::json* extension(const nlohmann::json* object, const std::string& name);
// extras.pinocchio
[[nodiscard]] const nlohmann::json* our_extras(const nlohmann::json* object);

// What a JSON pointer names within `object`; null: nothing.
[[nodiscard]] const nlohmann::json* find_at(const nlohmann::json* object, std::string_view pointer);
// The JSON pointer of a part of `root`, which has to be one of its parts.
[[nodiscard]] std::string pointer_to(const nlohmann::json& root, const nlohmann::json& part);

}  // namespace pinocchio
