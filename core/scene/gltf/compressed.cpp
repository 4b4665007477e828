#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/scene/gltf/buffers.h"
#include "core/scene/gltf/format/json.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// What an accessor's numbers are.
struct Numbers {
  int component_type = kGltfFloat, components = 1;
  bool normalized = false;
};

// Appends an accessor on bytes of its own, elements one after the other.
int add_accessor(GltfFile& file, FileBytes bytes, const Numbers& numbers, std::size_t count) {
  file.buffer_views.push_back({as_int(file.buffers.size()), 0, bytes.size()});
  file.add_buffer(std::move(bytes));
  GltfAccessor& accessor = file.accessors.emplace_back();
  accessor.buffer_view = as_int(file.buffer_views.size() - 1);
  accessor.count = count;
  accessor.component_type = numbers.component_type;
  accessor.components = numbers.components;
  accessor.normalized = numbers.normalized;
  return as_int(file.accessors.size() - 1);
}

// Draco converts integers that its own flag says are normalized. Encoders leave that unset: then the accessor
// normalizes them, as it does without Draco.
Numbers numbers_of(const GltfAccessor& own, const draco::PointAttribute& attribute) {
  const bool integers = own.component_type <= kGltfUnsignedShort && IsDataTypeIntegral(attribute.data_type());
  if (!own.normalized || !integers || attribute.normalized()) return {kGltfFloat, own.components, false};
  return {own.component_type, own.components, true};
}

template <class Number, int kComponents>
FileBytes values_of(const draco::PointAttribute& attribute, std::size_t points) {
  FileBytes bytes(points * kComponents * sizeof(Number));
  for (std::size_t i = 0; i < points; ++i) {
    Number values[kComponents] = {};
    attribute.ConvertValue<Number, kComponents>(attribute.mapped_index(draco::PointIndex(as_uint32(i))),
                                                values);
    std::memcpy(bytes.data() + i * sizeof values, values, sizeof values);
  }
  return bytes;
}

template <class Number>
FileBytes values_of(const draco::PointAttribute& attribute, std::size_t points, int components) {
  switch (components) {
    case 2:
      return values_of<Number, 2>(attribute, points);
    case 3:
      return values_of<Number, 3>(attribute, points);
    case 4:
      return values_of<Number, 4>(attribute, points);
    default:
      return {};
  }
}

// Empty: no attribute of vertices has so many components.
FileBytes values_of(const draco::PointAttribute& attribute, std::size_t points, const Numbers& numbers) {
  switch (numbers.component_type) {
    case kGltfByte:
      return values_of<std::int8_t>(attribute, points, numbers.components);
    case kGltfUnsignedByte:
      return values_of<std::uint8_t>(attribute, points, numbers.components);
    case kGltfShort:
      return values_of<std::int16_t>(attribute, points, numbers.components);
    case kGltfUnsignedShort:
      return values_of<std::uint16_t>(attribute, points, numbers.components);
    default:
      return values_of<float>(attribute, points, numbers.components);
  }
}

class DracoPrimitive {
 public:
  DracoPrimitive(GltfFile& file, GltfPrimitive& primitive) : file_(file), primitive_(primitive) {}

  Expected<void> unpack() {
    const auto bytes = file_.bytes(index_member(primitive_.draco, "bufferView"), kWhose);
    if (!bytes) return Unexpected(bytes.error());
    if (const Expected<void> fits = within_limit(); !fits) return fits;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    draco::Decoder decoder;
    draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
      return file_.error(std::string(kWhose) + " cannot be unpacked: " + decoded.status().error_msg_string());
    return add_accessors(*decoded.value());
  }

 private:
  static constexpr const char* kWhose = "a primitive of KHR_draco_mesh_compression";

  // Claims the unpacked size that the accessors state.
  Expected<void> within_limit() {
    std::uint64_t bytes = 0;
    const auto add = [&](int accessor, std::uint64_t each) {
      if (in_range(accessor, file_.accessors))
        bytes += std::min<std::uint64_t>(item_of(file_.accessors, accessor).count, 1u << 31) * each;
    };
    add(primitive_.indices, sizeof(std::uint32_t));
    for (const auto& [name, accessor] : primitive_.attributes) add(accessor, sizeof(glm::vec4));
    if (!file_.limit->take(file_.path.string(), kWhose, bytes, 1)) return Unexpected(*file_.limit->error());
    return {};
  }

  Expected<void> add_accessors(const draco::Mesh& mesh) {
    const nlohmann::json* ids = member(primitive_.draco, "attributes");
    for (auto& [name, accessor] : primitive_.attributes) {
      if (!member(ids, name)) continue;  // stays uncompressed
      const int id = index_member(ids, name);
      const draco::PointAttribute* attribute = id >= 0 ? mesh.GetAttributeByUniqueId(as_uint32(id)) : nullptr;
      if (!attribute || !in_range(accessor, file_.accessors))
        return file_.error(std::string(kWhose) + " lacks its attribute " + name);
      const Numbers numbers = numbers_of(item_of(file_.accessors, accessor), *attribute);
      const std::size_t points = mesh.num_points();
      FileBytes values = values_of(*attribute, points, numbers);
      if (values.size() > 0) accessor = add_accessor(file_, std::move(values), numbers, points);
    }
    FileBytes indices(std::size_t{mesh.num_faces()} * sizeof(glm::uvec3));
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
      const draco::Mesh::Face& face = mesh.face(f);
      const glm::uvec3 corners(face[0].value(), face[1].value(), face[2].value());
      std::memcpy(indices.data() + f.value() * sizeof corners, &corners, sizeof corners);
    }
    primitive_.mode = kGltfTriangles;
    primitive_.indices = add_accessor(file_, std::move(indices), {kGltfUnsignedInt, 1, false},
                                      std::size_t{3} * mesh.num_faces());
    return {};
  }

  GltfFile& file_;
  GltfPrimitive& primitive_;
};

}  // namespace

Expected<void> unpack_draco(GltfFile& file) {
  for (GltfMesh& mesh : file.meshes)
    for (GltfPrimitive& primitive : mesh.primitives) {
      throw_if_cancelled(file.progress);
      if (!primitive.draco) continue;
      if (const Expected<void> unpacked = DracoPrimitive(file, primitive).unpack(); !unpacked)
        return unpacked;
    }
  return {};
}

Expected<FileBytes> unpack_meshopt(const GltfFile& file, const nlohmann::json& packed,
                                   const std::string& extension, const std::string& whose) {
  const std::size_t buffer = value_member<std::size_t>(&packed, "buffer").value_or(file.buffers.size());
  const std::size_t offset = value_member<std::size_t>(&packed, "byteOffset").value_or(0),
                    length = value_member<std::size_t>(&packed, "byteLength").value_or(0);
  const std::size_t count = value_member<std::size_t>(&packed, "count").value_or(0),
                    stride = value_member<std::size_t>(&packed, "byteStride").value_or(0);
  if (buffer >= file.buffers.size() || offset > file.buffers[buffer].size() ||
      length > file.buffers[buffer].size() - offset)
    return file.error(whose + " reaches beyond its buffer");
  const std::string mode = text_member(&packed, "mode"), filter = text_member(&packed, "filter");
  const bool vertices = mode == "ATTRIBUTES";
  if (vertices ? stride == 0 || stride > 256 || stride % 4 != 0
               : (stride != 2 && stride != 4) || (mode == "TRIANGLES" && count % 3 != 0))
    return file.error(whose + " has a stride or count that its mode does not know");
  const auto not_read = [&](const std::string& what) {
    return file.error(whose + " of " + extension + " is packed with " + what + ", which is not read",
                      "pack it with EXT_meshopt_compression, or not at all");
  };
  constexpr unsigned char kVersion1 = 0xa1;  // only KHR_meshopt_compression defines it
  const unsigned char* from = file.buffers[buffer].data() + offset;
  if (vertices && length > 0 && from[0] == kVersion1) return not_read("version 1 of the vertex codec");
  if (constexpr std::array<std::string_view, 5> kFilters{"", "NONE", "OCTAHEDRAL", "QUATERNION",
                                                         "EXPONENTIAL"};
      std::ranges::find(kFilters, filter) == kFilters.end())
    return not_read("the filter '" + filter + "'");
  if ((filter == "OCTAHEDRAL" && stride != 4 && stride != 8) || (filter == "QUATERNION" && stride != 8))
    return file.error(whose + " has a stride that its filter does not know");
  if (!file.limit->take(file.path.string(), whose, count, stride)) return Unexpected(*file.limit->error());
  FileBytes bytes(count * stride);
  const int failure =
      vertices              ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, length)
      : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, length)
      : mode == "INDICES"   ? meshopt_decodeIndexSequence(bytes.data(), count, stride, from, length)
                            : -1;
  if (failure != 0) return file.error(whose + " cannot be unpacked (" + extension + ", mode '" + mode + "')");
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
  return bytes;
}

}  // namespace pinocchio
