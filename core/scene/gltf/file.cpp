#include "core/scene/gltf/file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

#include "core/base/large_memory.h"
#include "core/parallel/parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Elements of an accessor or of its sparse part, known to lie within their buffer.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
  int component_type = 0;
};

// Writes `count` elements' numbers one after the other; integers times `scale`, clamped to -1.
template <class T, class Out>
void convert_from(const Elements& from, std::size_t first, std::size_t count, std::size_t width, double scale,
                  Out* to) {
  for (std::size_t i = first; i < first + count; ++i)
    for (std::size_t c = 0; c < width; ++c) {
      T value;
      std::memcpy(&value, from.first + i * from.stride + c * sizeof value, sizeof value);
      if constexpr (std::is_same_v<Out, float>)
        *to++ = as_float(scale == 1.0 ? as_double(value) : std::max(as_double(value) * scale, -1.0));
      else
        *to++ = static_cast<Out>(value);
    }
}

template <class Out>
void convert(const Elements& from, std::size_t first, std::size_t count, std::size_t width, double scale,
             Out* to) {
  switch (from.component_type) {
    case kGltfByte:
      return convert_from<std::int8_t>(from, first, count, width, scale, to);
    case kGltfUnsignedByte:
      return convert_from<std::uint8_t>(from, first, count, width, scale, to);
    case kGltfShort:
      return convert_from<std::int16_t>(from, first, count, width, scale, to);
    case kGltfUnsignedShort:
      return convert_from<std::uint16_t>(from, first, count, width, scale, to);
    case kGltfUnsignedInt:
      return convert_from<std::uint32_t>(from, first, count, width, scale, to);
    case kGltfFloat:
      if constexpr (std::is_same_v<Out, float>)
        for (std::size_t i = first; i < first + count; ++i, to += width)
          std::memcpy(to, from.first + i * from.stride, width * sizeof(float));
      return;
    default:
      return;
  }
}

// A component type; `largest` is what normalised integers count as 1.
struct ComponentType {
  int type;
  std::size_t bytes;
  double largest;
  bool is_index;
};
constexpr std::array kComponentTypes{
    ComponentType{kGltfByte, 1, 127.0, false},     ComponentType{kGltfUnsignedByte, 1, 255.0, true},
    ComponentType{kGltfShort, 2, 32767.0, false},  ComponentType{kGltfUnsignedShort, 2, 65535.0, true},
    ComponentType{kGltfUnsignedInt, 4, 1.0, true}, ComponentType{kGltfFloat, 4, 1.0, false}};

// Null: glTF does not know the type.
const ComponentType* find_component_type(int type) {
  const auto* const found = std::ranges::find(kComponentTypes, type, &ComponentType::type);
  return found == kComponentTypes.end() ? nullptr : found;
}

bool is_index_type(int type) {
  const ComponentType* known = find_component_type(type);
  return known && known->is_index;
}

Expected<ComponentType> component_type_of(const GltfFile& file, const std::string& whose, int type) {
  if (const ComponentType* known = find_component_type(type)) return *known;
  return file.error(whose + " has the component type " + std::to_string(type) + ", which glTF does not know");
}

Expected<Elements> elements(const GltfFile& file, const std::string& whose, int view_index,
                            std::size_t offset, std::size_t count, int component_type, int components) {
  const Expected<ComponentType> type = component_type_of(file, whose, component_type);
  if (!type) return Unexpected(type.error());
  if (!in_range(view_index, file.buffer_views))
    return file.error(whose + " names buffer view " + which_of(view_index, file.buffer_views));
  const GltfBufferView& view = item_of(file.buffer_views, view_index);
  if (!in_range(view.buffer, file.buffers))
    return file.error(whose + " lies in buffer " + which_of(view.buffer, file.buffers));
  const std::span<const unsigned char> data = item_of(file.buffers, view.buffer);

  const std::size_t element_bytes = type->bytes * components;
  const std::size_t stride = view.byte_stride > 0 ? view.byte_stride : element_bytes;
  const bool view_fits =
      view.byte_offset <= data.size() && view.byte_length <= data.size() - view.byte_offset;
  const bool fits = count == 0 || (offset <= view.byte_length && element_bytes <= view.byte_length - offset &&
                                   (count - 1) <= (view.byte_length - offset - element_bytes) / stride);
  if (!view_fits || !fits) return file.error(whose + " reaches beyond its buffer");
  return Elements{data.data() + view.byte_offset + offset, stride, count, component_type};
}

constexpr std::size_t kElementsAtOnce = 1 << 16;

// The elements' numbers in place. Null: they have to be converted or do not lie one after the other.
template <class Out>
const Out* as_stored(const Elements& from, std::size_t width) {
  constexpr int kSame = std::is_same_v<Out, float> ? kGltfFloat : kGltfUnsignedInt;
  const bool aligned = reinterpret_cast<std::uintptr_t>(from.first) % alignof(Out) == 0;
  const bool same = from.component_type == kSame && from.stride == width * sizeof(Out);
  return aligned && same ? reinterpret_cast<const Out*>(from.first) : nullptr;
}

// Overwrites elements by those of the accessor's sparse part.
template <class Out>
Expected<void> overwrite(const GltfFile& file, const std::string& accessor_name, const GltfAccessor& accessor,
                         double scale, Out* numbers) {
  const GltfAccessor::Sparse& sparse = *accessor.sparse;
  const std::string whose = accessor_name + "'s sparse part";
  const std::size_t count = sparse.count;
  if (!is_index_type(sparse.index_type))
    return file.error(whose + " has indices that are not unsigned integers");
  const Expected<Elements> places = elements(file, whose, sparse.indices.buffer_view,
                                             sparse.indices.byte_offset, count, sparse.index_type, 1);
  if (!places) return Unexpected(places.error());
  const Expected<Elements> values =
      elements(file, whose, sparse.values.buffer_view, sparse.values.byte_offset, count,
               accessor.component_type, accessor.components);
  if (!values) return Unexpected(values.error());
  const auto width = as_size(accessor.components);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kElementsAtOnce == 0) throw_if_cancelled(file.progress);
    std::uint32_t to = 0;
    convert(*places, i, 1, 1, 1.0, &to);
    if (to >= accessor.count) return file.error(whose + " reaches beyond it");
    convert(*values, i, 1, width, scale, numbers + width * to);
  }
  return {};
}

// Appends an accessor's numbers to `to`, each element of which holds one or more of them.
template <class Out, class T>
Expected<void> append_numbers(const GltfFile& file, int index, int components, std::vector<T>& to) {
  const std::string whose = "accessor " + std::to_string(index);
  if (!in_range(index, file.accessors))
    return file.error("names accessor " + which_of(index, file.accessors));
  const GltfAccessor& accessor = item_of(file.accessors, index);
  if (accessor.components != components)
    return file.error(whose + " does not hold " + std::to_string(components) + " numbers an element");
  constexpr std::size_t kMostElements = 0xffffffffu;
  if (accessor.count > kMostElements) return file.error(whose + " holds too many elements");

  const auto width = as_size(components);
  const Expected<ComponentType> type = component_type_of(file, whose, accessor.component_type);
  if (!type) return Unexpected(type.error());
  const double scale = accessor.normalized ? 1.0 / type->largest : 1.0;
  const std::size_t first = to.size(), more = width * accessor.count / (sizeof(T) / sizeof(Out));
  const auto numbers = [&] { return reinterpret_cast<Out*>(to.data() + first); };
  if (accessor.buffer_view >= 0) {
    const Expected<Elements> from = elements(file, whose, accessor.buffer_view, accessor.byte_offset,
                                             accessor.count, accessor.component_type, components);
    if (!from) return Unexpected(from.error());
    throw_if_cancelled(file.progress);
    if (const Out* stored = as_stored<Out>(*from, width)) {
      append_large(to, std::span(reinterpret_cast<const T*>(stored), more));
    } else {
      resize_large(to, first + more);
      for_each_part(from->count, kElementsAtOnce, [&](std::size_t begin, std::size_t end) {
        throw_if_cancelled(file.progress);
        convert(*from, begin, end - begin, width, scale, numbers() + begin * width);
      });
    }
  } else {  // zeros, as the specification has it
    if (!file.limit->take(file.path.string(), whose, accessor.count, width * sizeof(Out)))
      return Unexpected(*file.limit->error());
    resize_large(to, first + more, T(0));
  }
  return accessor.sparse ? overwrite(file, whose, accessor, scale, numbers()) : Expected<void>();
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
  if (!in_range(buffer_view, buffer_views))
    return error(whose + " names buffer view " + which_of(buffer_view, buffer_views));
  const std::size_t count = item_of(buffer_views, buffer_view).byte_length;
  const Expected<Elements> all =
      elements(*this, whose, buffer_view, 0, std::min<std::size_t>(count, 1), kGltfUnsignedByte, 1);
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
  if (!in_range(accessor, accessors)) return error("names accessor " + which_of(accessor, accessors));
  return item_of(accessors, accessor).count;
}

Expected<void> GltfFile::check_indices(int accessor) const {
  if (in_range(accessor, accessors) && !is_index_type(item_of(accessors, accessor).component_type))
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

}  // namespace pinocchio
