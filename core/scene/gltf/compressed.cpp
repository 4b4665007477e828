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

// Appends the accessor, whose elements are these bytes, one after the other.
int add_accessor(GltfFile& file, FileBytes bytes, GltfAccessor accessor) {
  file.buffer_views.push_back({as_int(file.buffers.size()), 0, bytes.size()});
  file.add_buffer(std::move(bytes));
  accessor.buffer_view = as_int(file.buffer_views.size() - 1);
  file.accessors.push_back(accessor);
  return as_int(file.accessors.size() - 1);
}

// The accessor of an unpacked attribute in place of its own, which states what is packed. Draco normalizes
// integers itself if its own flag says so. Encoders leave that unset: then the accessor does it.
GltfAccessor unpacked_accessor(const GltfAccessor& own, const draco::PointAttribute& attribute,
                               std::size_t points) {
  const bool normalizes = own.normalized && own.component_type <= kGltfUnsignedShort &&
                          IsDataTypeIntegral(attribute.data_type()) && !attribute.normalized();
  GltfAccessor unpacked;
  unpacked.count = points;
  unpacked.component_type = normalizes ? own.component_type : kGltfFloat;
  unpacked.components = own.components;
  unpacked.normalized = normalizes;
  return unpacked;
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

// In the accessor's type. Empty: no attribute of vertices has so many components.
FileBytes values_of(const draco::PointAttribute& attribute, const GltfAccessor& accessor) {
  const std::size_t points = accessor.count;
  const int components = accessor.components;
  switch (accessor.component_type) {
    case kGltfByte:
      return values_of<std::int8_t>(attribute, points, components);
    case kGltfUnsignedByte:
      return values_of<std::uint8_t>(attribute, points, components);
    case kGltfShort:
      return values_of<std::int16_t>(attribute, points, components);
    case kGltfUnsignedShort:
      return values_of<std::uint16_t>(attribute, points, components);
    default:
      return values_of<float>(attribute, points, components);
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
    if (const Expected<void> fits = within_limit(*decoded.value()); !fits) return fits;
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
    return claim(bytes);
  }

  // Claims what was unpacked, where the accessors state less.
  Expected<void> within_limit(const draco::Mesh& mesh) {
    return claim(std::uint64_t{mesh.num_faces()} * sizeof(glm::uvec3) +
                 std::uint64_t{mesh.num_points()} * sizeof(glm::vec4) * primitive_.attributes.size());
  }

  // `bytes`: those claimed before included.
  Expected<void> claim(std::uint64_t bytes) {
    const std::uint64_t more = bytes - std::min(bytes, claimed_);
    claimed_ += more;
    if (!file_.limit->take(file_.path.string(), kWhose, more, 1)) return Unexpected(*file_.limit->error());
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
      const GltfAccessor unpacked =
          unpacked_accessor(item_of(file_.accessors, accessor), *attribute, mesh.num_points());
      FileBytes values = values_of(*attribute, unpacked);
      if (values.size() > 0) accessor = add_accessor(file_, std::move(values), unpacked);
    }
    FileBytes indices(std::size_t{mesh.num_faces()} * sizeof(glm::uvec3));
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
      const draco::Mesh::Face& face = mesh.face(f);
      const glm::uvec3 corners(face[0].value(), face[1].value(), face[2].value());
      std::memcpy(indices.data() + f.value() * sizeof corners, &corners, sizeof corners);
    }
    primitive_.mode = kGltfTriangles;
    GltfAccessor corners;
    corners.count = std::size_t{3} * mesh.num_faces();
    corners.component_type = kGltfUnsignedInt;
    corners.components = 1;
    primitive_.indices = add_accessor(file_, std::move(indices), corners);
    return {};
  }

  GltfFile& file_;
  GltfPrimitive& primitive_;
  std::uint64_t claimed_ = 0;
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
