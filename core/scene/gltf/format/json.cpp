#include "core/scene/gltf/format/json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

std::optional<std::string> find_pointer(const Json& root, const Json& part) {
  if (&root == &part) return "";
  if (!root.is_structured()) return std::nullopt;
  for (const auto& item : root.items())
    if (std::optional<std::string> below = find_pointer(item.value(), part)) return "/" + item.key() + *below;
  return std::nullopt;
}

bool are_numbers(const Json& array) {
  return array.is_array() && std::ranges::all_of(array, [](const Json& value) { return value.is_number(); });
}

}  // namespace

template <>
std::optional<double> value_of(const Json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

template <>
std::optional<float> value_of(const Json& value) {
  return value.is_number() ? std::optional(as_float(value.get<double>())) : std::nullopt;
}

template <>
std::optional<bool> value_of(const Json& value) {
  return value.is_boolean() ? std::optional(value.get<bool>()) : std::nullopt;
}

template <>
std::optional<std::size_t> value_of(const Json& value) {
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  const double number = value_of<double>(value).value_or(-1.0);
  constexpr double kMost = 9e15;  // every whole number below it is a double
  if (!(number >= 0.0 && number < kMost && number == std::floor(number))) return std::nullopt;
  return as_size(number);
}

template <>
std::optional<glm::vec2> value_of(const Json& value) {
  if (!are_numbers(value) || value.size() != 2) return std::nullopt;
  return glm::vec2(value[0].get<double>(), value[1].get<double>());
}

template <>
std::optional<glm::vec3> value_of(const Json& value) {
  if (const std::optional<float> all = value_of<float>(value)) return glm::vec3(*all);
  if (!are_numbers(value) || value.size() != 3) return std::nullopt;
  return glm::vec3(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
}

int index_of(const Json& value) {
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  const std::optional<std::size_t> index = value_of<std::size_t>(value);
  return index ? as_int(std::min(*index, kMost)) : -1;
}

const Json* member(const Json* object, const std::string& key) {
  if (!object || !object->is_object()) return nullptr;
  const auto found = object->find(key);
  return found == object->end() ? nullptr : &*found;
}

int index_member(const Json* object, const std::string& key) {
  const Json* const value = member(object, key);
  return value ? index_of(*value) : -1;
}

std::string text_member(const Json* object, const std::string& key) {
  const Json* const value = member(object, key);
  return value && value->is_string() ? value->get<std::string>() : std::string();
}

const Json& array_member(const Json* object, const std::string& key) {
  static const Json kNone = Json::array();
  const Json* const value = member(object, key);
  return value && value->is_array() ? *value : kNone;
}

std::vector<int> indices_member(const Json* object, const std::string& key) {
  std::vector<int> indices;
  for (const Json& value : array_member(object, key)) indices.push_back(index_of(value));
  return indices;
}

std::vector<double> numbers_member(const Json* object, const std::string& key) {
  const Json& array = array_member(object, key);
  return are_numbers(array) ? array.get<std::vector<double>>() : std::vector<double>();
}

const Json* extension(const Json* object, const std::string& name) {
  const Json* const value = member(member(object, "extensions"), name);
  return value && value->is_object() ? value : nullptr;
}

const Json* our_extras(const Json* object) {
  return member(member(object, "extras"), "pinocchio");
}

const Json* find_at(const Json* object, std::string_view pointer) {
  while (object && !pointer.empty()) {
    pointer.remove_prefix(1);  // the slash
    const std::string_view key = pointer.substr(0, pointer.find('/'));
    object = member(object, std::string(key));
    pointer.remove_prefix(key.size());
  }
  return object;
}

std::string pointer_to(const Json& root, const Json& part) {
  return find_pointer(root, part).value_or("");
}

}  // namespace pinocchio
