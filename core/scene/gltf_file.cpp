#include "core/scene/gltf_file.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "core/base/large_memory.h"
#include "core/parallel/parts.h"

namespace pinocchio {
namespace {

// Elements of an accessor or of its sparse part, known to lie within their buffer.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
  int component_type = 0;
};

// `count` elements' numbers, one after the other; integers times `scale`.
template <class T, class Out>
void convert_from(const Elements& from, std::size_t first, std::size_t count, std::size_t width, double scale,
                  Out* to) {
  for (std::size_t i = first; i < first + count; ++i)
    for (std::size_t c = 0; c < width; ++c) {
      T value;
      std::memcpy(&value, from.first + i * from.stride + c * sizeof value, sizeof value);
      if constexpr (std::is_same_v<Out, float>)
        *to++ = static_cast<float>(static_cast<double>(value) * scale);
      else
        *to++ = static_cast<Out>(value);
    }
}

template <class Out>
void convert(const Elements& from, std::size_t first, std::size_t count, std::size_t width, double scale,
             Out* to) {
  switch (from.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return convert_from<std::int8_t>(from, first, count, width, scale, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return convert_from<std::uint8_t>(from, first, count, width, scale, to);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return convert_from<std::int16_t>(from, first, count, width, scale, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return convert_from<std::uint16_t>(from, first, count, width, scale, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return convert_from<std::uint32_t>(from, first, count, width, scale, to);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      if constexpr (std::is_same_v<Out, float>)
        for (std::size_t i = first; i < first + count; ++i, to += width)
          std::memcpy(to, from.first + i * from.stride, width * sizeof(float));
      return;
    default:
      return;
  }
}

double largest_value(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return 127.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return 32767.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 65535.0;
    default:
      return 1.0;
  }
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// tinygltf knows INT and DOUBLE too, glTF does not.
bool is_component_type(int type) {
  return is_index_type(type) || type == TINYGLTF_COMPONENT_TYPE_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

template <class T>
bool in_range(int index, const std::vector<T>& items) {
  return index >= 0 && static_cast<std::size_t>(index) < items.size();
}

// Of an index that names nothing.
template <class T>
std::string which_of(int index, const std::vector<T>& items) {
  return std::to_string(index) + ", there are " + std::to_string(items.size());
}

Expected<Elements> elements(const GltfFile& file, const std::string& whose, int view_index,
                            std::size_t offset, std::size_t count, int component_type, int components) {
  const tinygltf::Model& model = file.model;
  if (!is_component_type(component_type))
    return file.error(whose + " has the component type " + std::to_string(component_type) +
                      ", which glTF does not know");
  const int component_bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type));
  if (!in_range(view_index, model.bufferViews))
    return file.error(whose + " names buffer view " + which_of(view_index, model.bufferViews));
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  if (!in_range(view.buffer, file.buffers))
    return file.error(whose + " lies in buffer " + which_of(view.buffer, file.buffers));
  const std::span<const unsigned char> data = file.buffers[static_cast<std::size_t>(view.buffer)];

  const auto element_bytes = static_cast<std::size_t>(component_bytes) * static_cast<std::size_t>(components);
  const std::size_t stride = view.byteStride > 0 ? view.byteStride : element_bytes;
  const bool view_fits = view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset;
  const bool fits = count == 0 || (offset <= view.byteLength && element_bytes <= view.byteLength - offset &&
                                   (count - 1) <= (view.byteLength - offset - element_bytes) / stride);
  if (!view_fits || !fits) return file.error(whose + " reaches beyond its buffer");
  return Elements{data.data() + view.byteOffset + offset, stride, count, component_type};
}

constexpr std::size_t kElementsBetweenLooks = 1 << 16;

// The elements' numbers, where they lie one after the other as ours do; null where they do not.
template <class Out>
const Out* as_stored(const Elements& from, std::size_t width) {
  constexpr int kSame =
      std::is_same_v<Out, float> ? TINYGLTF_COMPONENT_TYPE_FLOAT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  const bool aligned = reinterpret_cast<std::uintptr_t>(from.first) % alignof(Out) == 0;
  const bool same = from.component_type == kSame && from.stride == width * sizeof(Out);
  return aligned && same ? reinterpret_cast<const Out*>(from.first) : nullptr;
}

// What the sparse part has otherwise.
template <class Out>
Expected<void> overwrite(const GltfFile& file, const std::string& whose, const tinygltf::Accessor& accessor,
                         int components, double scale, Out* numbers) {
  const auto count = static_cast<std::size_t>(std::max(accessor.sparse.count, 0));
  const auto& where = accessor.sparse.indices;
  if (!is_index_type(where.componentType))
    return file.error(whose + "'s sparse part has indices that are not unsigned integers");
  const Expected<Elements> places =
      elements(file, whose + "'s sparse part", where.bufferView, static_cast<std::size_t>(where.byteOffset),
               count, where.componentType, 1);
  if (!places) return Unexpected(places.error());
  const auto& what = accessor.sparse.values;
  const Expected<Elements> values =
      elements(file, whose + "'s sparse part", what.bufferView, static_cast<std::size_t>(what.byteOffset),
               count, accessor.componentType, components);
  if (!values) return Unexpected(values.error());
  const auto width = static_cast<std::size_t>(components);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kElementsBetweenLooks == 0) throw_if_cancelled(file.progress);
    std::uint32_t to = 0;
    convert(*places, i, 1, 1, 1.0, &to);
    if (to >= accessor.count) return file.error(whose + "'s sparse part reaches beyond it");
    convert(*values, i, 1, width, scale, numbers + width * to);
  }
  return {};
}

// Appends an accessor's numbers to `to`, of whose elements each holds one or more.
template <class Out, class T>
Expected<void> append_numbers(const GltfFile& file, int index, int components, std::vector<T>& to) {
  const std::string whose = "accessor " + std::to_string(index);
  if (!in_range(index, file.model.accessors))
    return file.error("names accessor " + which_of(index, file.model.accessors));
  const tinygltf::Accessor& accessor = file.model.accessors[static_cast<std::size_t>(index)];
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components)
    return file.error(whose + " does not hold " + std::to_string(components) + " numbers an element");
  constexpr std::size_t kMostElements = 0xffffffffu;
  if (accessor.count > kMostElements) return file.error(whose + " holds too many elements");

  const auto width = static_cast<std::size_t>(components);
  const double scale = accessor.normalized ? 1.0 / largest_value(accessor.componentType) : 1.0;
  const std::size_t first = to.size(), more = width * accessor.count / (sizeof(T) / sizeof(Out));
  const auto numbers = [&] { return reinterpret_cast<Out*>(to.data() + first); };
  if (accessor.bufferView >= 0) {
    const Expected<Elements> from = elements(file, whose, accessor.bufferView, accessor.byteOffset,
                                             accessor.count, accessor.componentType, components);
    if (!from) return Unexpected(from.error());
    throw_if_cancelled(file.progress);
    if (const Out* stored = as_stored<Out>(*from, width)) {
      append_large(to, std::span(reinterpret_cast<const T*>(stored), more));
    } else {
      resize_large(to, first + more);
      for_each_part(from->count, kElementsBetweenLooks, [&](std::size_t begin, std::size_t end) {
        throw_if_cancelled(file.progress);
        convert(*from, begin, end - begin, width, scale, numbers() + begin * width);
      });
    }
  } else {  // zeros, says glTF
    if (!is_component_type(accessor.componentType))
      return file.error(whose + " has the component type " + std::to_string(accessor.componentType) +
                        ", which glTF does not know");
    if (!file.limit->take(file.path.string(), whose, accessor.count, width * sizeof(Out)))
      return Unexpected(*file.limit->error());
    resize_large(to, first + more, T(0));
  }
  if (!accessor.sparse.isSparse) return {};
  return overwrite(file, whose, accessor, components, scale, numbers());
}

template <class Out>
Expected<std::vector<Out>> numbers_of(const GltfFile& file, int index, int components) {
  std::vector<Out> numbers;
  const Expected<void> read = append_numbers<Out>(file, index, components, numbers);
  if (!read) return Unexpected(read.error());
  return numbers;
}

}  // namespace

Expected<std::span<const unsigned char>> GltfFile::bytes(int buffer_view, const std::string& whose) const {
  if (!in_range(buffer_view, model.bufferViews))
    return error(whose + " names buffer view " + which_of(buffer_view, model.bufferViews));
  const std::size_t count = model.bufferViews[static_cast<std::size_t>(buffer_view)].byteLength;
  const Expected<Elements> all = elements(*this, whose, buffer_view, 0, std::min<std::size_t>(count, 1),
                                          TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, 1);
  if (!all) return Unexpected(all.error());
  return std::span(all->first, count);
}

Expected<std::vector<float>> GltfFile::floats(int accessor, int components) const {
  return numbers_of<float>(*this, accessor, components);
}

Expected<void> GltfFile::append(int accessor, std::vector<glm::vec2>& to) const {
  return append_numbers<float>(*this, accessor, 2, to);
}
Expected<void> GltfFile::append(int accessor, std::vector<glm::vec3>& to) const {
  return append_numbers<float>(*this, accessor, 3, to);
}
Expected<void> GltfFile::append(int accessor, std::vector<glm::vec4>& to) const {
  return append_numbers<float>(*this, accessor, 4, to);
}

Expected<std::size_t> GltfFile::count(int accessor) const {
  if (!in_range(accessor, model.accessors))
    return error("names accessor " + which_of(accessor, model.accessors));
  return model.accessors[static_cast<std::size_t>(accessor)].count;
}

Expected<void> GltfFile::check_indices(int accessor) const {
  if (in_range(accessor, model.accessors) &&
      !is_index_type(model.accessors[static_cast<std::size_t>(accessor)].componentType))
    return error("accessor " + std::to_string(accessor) + " holds indices that are not unsigned integers");
  return {};
}

Expected<std::vector<std::uint32_t>> GltfFile::indices(int accessor) const {
  if (const Expected<void> checked = check_indices(accessor); !checked) return Unexpected(checked.error());
  return numbers_of<std::uint32_t>(*this, accessor, 1);
}

Expected<void> GltfFile::append_triangles(int accessor, std::vector<glm::uvec3>& to) const {
  if (const Expected<void> checked = check_indices(accessor); !checked) return checked;
  return append_numbers<std::uint32_t>(*this, accessor, 1, to);
}

const tinygltf::Value* member(const tinygltf::Value& object, const std::string& key) {
  return object.IsObject() && object.Has(key) ? &object.Get(key) : nullptr;
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

const tinygltf::Value* our_extras(const tinygltf::Value& extras) {
  return member(extras, "pinocchio");
}

std::optional<float> number_member(const tinygltf::Value* object, const std::string& key) {
  const tinygltf::Value* value = object ? member(*object, key) : nullptr;
  if (!value || !value->IsNumber()) return std::nullopt;
  return static_cast<float>(value->GetNumberAsDouble());
}

std::optional<bool> bool_member(const tinygltf::Value* object, const std::string& key) {
  const tinygltf::Value* value = object ? member(*object, key) : nullptr;
  if (!value || !value->IsBool()) return std::nullopt;
  return value->Get<bool>();
}

std::optional<glm::vec2> vec2_member(const tinygltf::Value* object, const std::string& key) {
  const tinygltf::Value* value = object ? member(*object, key) : nullptr;
  if (!value || !value->IsArray() || value->ArrayLen() != 2) return std::nullopt;
  if (!value->Get(0).IsNumber() || !value->Get(1).IsNumber()) return std::nullopt;
  return glm::vec2(value->Get(0).GetNumberAsDouble(), value->Get(1).GetNumberAsDouble());
}

std::optional<glm::vec3> vec3_member(const tinygltf::Value* object, const std::string& key) {
  if (const std::optional<float> all = number_member(object, key)) return glm::vec3(*all);
  const tinygltf::Value* value = object ? member(*object, key) : nullptr;
  if (!value || !value->IsArray() || value->ArrayLen() != 3) return std::nullopt;
  glm::vec3 result;
  for (int i = 0; i < 3; ++i) {
    if (!value->Get(i).IsNumber()) return std::nullopt;
    result[i] = static_cast<float>(value->Get(i).GetNumberAsDouble());
  }
  return result;
}

}  // namespace pinocchio
