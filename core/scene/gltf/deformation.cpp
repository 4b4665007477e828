#include "core/scene/gltf/deformation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/finite.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::size_t kInfluencesASet = 4;
constexpr float kMostOffSum = 0.02f;  // larger than the rounding of 8-bit weights

// The attribute's accessor. -1: the primitive has none.
int accessor_of(const GltfAttributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? -1 : found->second;
}

std::string set_name(const char* attribute, std::size_t set) {
  return std::string(attribute) + "_" + std::to_string(set);
}

bool has_set(const GltfPrimitive& primitive, std::size_t set) {
  return primitive.attribute(set_name("JOINTS", set)) >= 0;
}

// The matrix of normals under the instance's transform.
glm::mat3 normals_of(const glm::mat4& instance) {
  return glm::transpose(glm::inverse(glm::mat3(instance)));
}

}  // namespace

DeformationReader::DeformationReader(const GltfFile& file, const GltfNode& node, std::uint32_t first_vertex,
                                     Warnings& warnings)
    : file_(file), node_(node), first_vertex_(first_vertex), warnings_(warnings) {
  if (!in_range(node.mesh, file.meshes)) return;
  std::size_t sets = 0;
  for (const GltfPrimitive& primitive : item_of(file.meshes, node.mesh).primitives) {
    targets_ = std::max(targets_, primitive.targets.size());
    for (const std::size_t set : {0u, 1u})
      if (has_set(primitive, set)) sets = std::max(sets, set + 1);
    if (has_set(primitive, 2) && node.skin >= 0)
      warn("joints beyond eight a vertex are left out", "its skin follows the first eight");
  }
  deformation_.targets.resize(targets_);
  if (!in_range(node.skin, file.skins)) return;
  if (sets == 0) {
    warn("its skin is left out, as no vertex names a joint", "it moves with its node alone");
    return;
  }
  joints_ = item_of(file.skins, node.skin).joints.size();
  deformation_.influences_per_vertex = sets * kInfluencesASet;
}

Expected<void> DeformationReader::add(const GltfPrimitive& primitive, std::uint32_t first, std::size_t count,
                                      std::span<const std::uint32_t> sources) {
  for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
    throw_if_cancelled(file_.progress);
    if (const Expected<void> added =
            add_target(primitive.targets[t], first, count, sources, deformation_.targets[t]);
        !added)
      return added;
  }
  return skinned() ? add_influences(primitive, count, sources) : Expected<void>();
}

Expected<void> DeformationReader::add_target(const GltfAttributes& accessors, std::uint32_t first,
                                             std::size_t count, std::span<const std::uint32_t> sources,
                                             MorphTarget& to) {
  constexpr std::array kNames{"POSITION", "NORMAL", "TANGENT"};
  for (const auto& [name, accessor] : accessors)
    if (std::ranges::find(kNames, name) == kNames.end())
      warn("morph targets of " + name + " are left out", "only its shape changes");
  std::array<std::vector<float>, 3> offsets;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const int accessor = accessor_of(accessors, kNames[i]);
    if (accessor < 0) continue;
    Expected<std::vector<float>> read = file_.floats(accessor, 3);
    if (!read) return Unexpected(read.error());
    if (read->size() != 3 * count)
      return file_.error("accessor " + std::to_string(accessor) +
                         " of a morph target does not hold one element a vertex");
    if (!std::ranges::all_of(*read, [](float f) { return std::isfinite(f); }))
      return file_.error("accessor " + std::to_string(accessor) +
                         " of a morph target holds no finite numbers");
    if (sources.empty() || i == 0) offsets[i] = std::move(*read);
  }
  const std::array<std::vector<glm::vec3>*, 3> kept{&to.positions, &to.normals, &to.tangents};
  for (std::size_t v = 0; v < (sources.empty() ? count : sources.size()); ++v) {
    const std::size_t from = sources.empty() ? v : sources[v];
    const auto offset = [&](std::size_t i) {
      const std::vector<float>& all = offsets[i];
      return all.empty() ? glm::vec3(0.0f) : glm::vec3(all[3 * from], all[3 * from + 1], all[3 * from + 2]);
    };
    if (offset(0) == glm::vec3(0.0f) && offset(1) == glm::vec3(0.0f) && offset(2) == glm::vec3(0.0f))
      continue;
    if (!file_.limit->take(file_.path.string(), "a morph target", 1,
                           sizeof(std::uint32_t) + 3 * sizeof(glm::vec3)))
      return Unexpected(*file_.limit->error());
    to.vertices.push_back(first - first_vertex_ + as_uint32(v));
    // Another primitive of the target may lack what this one has.
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (!offsets[i].empty() || !kept[i]->empty()) {
        kept[i]->resize(to.vertices.size() - 1, glm::vec3(0.0f));
        kept[i]->push_back(offset(i));
      }
  }
  return {};
}

Expected<void> DeformationReader::add_influences(const GltfPrimitive& primitive, std::size_t count,
                                                 std::span<const std::uint32_t> sources) {
  const std::size_t stride = deformation_.influences_per_vertex;
  if (!file_.limit->take(file_.path.string(), "a skin", count + sources.size(), stride * sizeof(Influence)))
    return Unexpected(*file_.limit->error());
  std::vector<Influence> influences(count * stride);
  for (std::size_t set = 0; set * kInfluencesASet < stride && has_set(primitive, set); ++set) {
    const Expected<std::vector<float>> joints = file_.floats(primitive.attribute(set_name("JOINTS", set)), 4);
    if (!joints) return Unexpected(joints.error());
    const Expected<std::vector<float>> weights =
        file_.floats(primitive.attribute(set_name("WEIGHTS", set)), 4);
    if (!weights) return Unexpected(weights.error());
    if (joints->size() != 4 * count || weights->size() != 4 * count)
      return file_.error("a primitive does not have joints and weights for each vertex");
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const float joint = (*joints)[i], weight = (*weights)[i];
      if (!std::isfinite(weight))
        return file_.error("a vertex has a joint's weight that is no finite number");
      if (weight <= 0.0f) continue;
      if (!(joint >= 0.0f && joint < joints_))
        return file_.error("a vertex names joint " + std::to_string(static_cast<long long>(joint)) +
                           " of skin " + std::to_string(node_.skin) + ", it has " + std::to_string(joints_));
      influences[i / 4 * stride + set * kInfluencesASet + i % 4] = {as_uint32(joint), weight};
    }
  }
  for (std::size_t v = 0; v < count; ++v) settle_weights(std::span(influences).subspan(v * stride, stride));
  std::vector<Influence>& all = deformation_.influences;
  if (sources.empty()) all.insert(all.end(), influences.begin(), influences.end());
  for (const std::uint32_t source : sources) {
    const auto from = influences.begin() + static_cast<std::ptrdiff_t>(source * stride);
    all.insert(all.end(), from, from + static_cast<std::ptrdiff_t>(stride));
  }
  return {};
}

void DeformationReader::settle_weights(std::span<Influence> of_vertex) {
  float sum = 0.0f;
  for (const Influence& by : of_vertex) sum += by.weight;
  if (!(std::abs(sum - 1.0f) <= kMostOffSum))
    warn("weights of its joints do not add up to 1", "they are scaled until they do");
  if (!(sum > 0.0f) || !std::isfinite(sum)) {
    of_vertex.front() = {of_vertex.front().joint, 1.0f};
    for (Influence& by : of_vertex.subspan(1)) by.weight = 0.0f;
    return;
  }
  for (Influence& by : of_vertex) by.weight /= sum;
}

void DeformationReader::place(const glm::mat4& instance, std::uint32_t first,
                              std::span<const glm::vec3> normals) {
  const glm::mat3 linear(instance), of_normals = normals_of(instance);
  const std::uint32_t begin = first - first_vertex_;
  for (MorphTarget& target : deformation_.targets) {
    const auto at = std::ranges::lower_bound(target.vertices, begin) - target.vertices.begin();
    for (auto i = as_size(at); i < target.vertices.size(); ++i) {
      const std::uint32_t v = target.vertices[i];
      if (v - begin >= normals.size()) break;
      if (!target.positions.empty()) target.positions[i] = linear * target.positions[i];
      // Keeps the offset's length relative to the normal, which is normalised once placed.
      if (!target.normals.empty()) {
        const float length = glm::length(of_normals * normals[v - begin]);
        target.normals[i] = length > 0.0f && std::isfinite(length) ? of_normals * target.normals[i] / length
                                                                   : glm::vec3(0.0f);
      }
      if (!target.tangents.empty()) target.tangents[i] = linear * target.tangents[i];
    }
  }
}

std::vector<float> DeformationReader::weights() const {
  std::vector<float> weights =
      node_.weights.empty() ? item_of(file_.meshes, node_.mesh).weights : node_.weights;
  weights.resize(targets_, 0.0f);
  return weights;
}

void DeformationReader::warn(const std::string& what, const std::string& lost) {
  warnings_.add({file_.path.string(), "mesh " + std::to_string(node_.mesh), what, lost});
}

std::vector<int> deforming_accessors(const GltfPrimitive& primitive) {
  std::vector<int> accessors;
  for (const char* name : {"JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"})
    accessors.push_back(primitive.attribute(name));
  for (const GltfAttributes& target : primitive.targets)
    for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) accessors.push_back(accessor_of(target, name));
  return accessors;
}

Expected<std::optional<Skin>> gltf_skin(const GltfFile& file, int skin,
                                        const std::vector<int>& place_of_node) {
  const GltfSkin& from = item_of(file.skins, skin);
  const std::string whose = "skin " + std::to_string(skin);
  Skin result;
  for (const int joint : from.joints) {
    if (!in_range(joint, place_of_node))
      return file.error(whose + " names node " + which_of(joint, place_of_node));
    result.joints.push_back(item_of(place_of_node, joint));
    if (result.joints.back() < 0) return std::optional<Skin>();
  }
  result.joint_from_mesh.resize(result.joints.size(), glm::mat4(1.0f));
  if (from.inverse_bind_matrices < 0) return std::optional(std::move(result));
  const Expected<std::vector<float>> matrices = file.floats(from.inverse_bind_matrices, 16);
  if (!matrices) return Unexpected(matrices.error());
  if (matrices->size() < 16 * result.joints.size())
    return file.error(whose + " has " + std::to_string(result.joints.size()) + " joints and " +
                      std::to_string(matrices->size() / 16) + " inverse bind matrices");
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    std::copy_n(matrices->begin() + static_cast<std::ptrdiff_t>(16 * j), 16,
                &result.joint_from_mesh[j][0][0]);
    for (int column = 0; column < 4; ++column)
      if (!is_finite(glm::vec3(result.joint_from_mesh[j][column])))
        return file.error(whose + " has inverse bind matrices that are not finite numbers");
  }
  return std::optional(std::move(result));
}

}  // namespace pinocchio
