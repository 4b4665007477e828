// EXT_lights_image_based: a cube map around a scene, converted to a picture in latitude and longitude. Only
// the first mip level is read: the others are blurred for a roughness, and rays sample it instead; for the
// same reason irradianceCoefficients are not read.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/image/codecs/texture_file.h"
#include "core/image/cube_map.h"
#include "core/image/tonemap.h"
#include "core/math/finite.h"
#include "core/scene/gltf/file.h"
#include "core/scene/gltf/format/json.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

constexpr const char* kExtension = "EXT_lights_image_based";

// The indices of the first mip level's six images; empty: the file does not say so.
std::vector<int> face_images(const GltfFile& file, const Json& light) {
  const Json& levels = array_member(&light, "specularImages");
  if (levels.empty() || !levels[0].is_array() || levels[0].size() != std::tuple_size_v<CubeMap>) return {};
  std::vector<int> images;
  for (const Json& face : levels[0]) {
    images.push_back(index_of(face));
    if (!in_range(images.back(), file.images)) return {};
  }
  return images;
}

glm::quat rotation_of(const Json& light) {
  const std::vector<double> r = numbers_member(&light, "rotation");
  if (r.size() != 4) return glm::quat(1, 0, 0, 0);
  const glm::quat q(glm::dquat(r[3], r[0], r[1], r[2]));
  const float length = glm::length(q);
  return std::isfinite(length) && length > 0.0f ? q / length : glm::quat(1, 0, 0, 0);
}

// sRGB; a PNG's alpha divides it (RGBD), which is how it can be brighter than white.
Image<glm::vec3> light_of(const Texture& texture, float intensity) {
  Image<glm::vec3> light(texture.texels.size());
  for (std::size_t i = 0; i < light.pixels().size(); ++i) {
    const glm::u8vec4& t = texture.texels[i];
    const float scale = intensity * 255.0f / std::max<int>(t.a, 1);
    light[i] = scale * glm::vec3(srgb8_to_linear(t.r), srgb8_to_linear(t.g), srgb8_to_linear(t.b));
  }
  return light;
}

// An error's message where it cannot be read.
Expected<CubeMap> cube_of(const GltfFile& file, const Json& light, Loading& loading) {
  const std::vector<int> images = face_images(file, light);
  if (images.empty()) return file.error("its specularImages do not begin with six images");
  std::vector<EncodedImage> encoded;
  for (const int image : images) {
    Expected<EncodedImage> one = gltf_image(file, image);
    if (!one) return Unexpected(one.error());
    encoded.push_back(std::move(*one));
  }
  const float given = value_member<float>(&light, "intensity").value_or(1.0f);
  const float intensity = std::isfinite(given) && given >= 0.0f ? given : 1.0f;
  CubeMap cube;
  const std::vector<Expected<DecodedImage>> decoded = decode_textures(encoded, loading);
  for (std::size_t i = 0; i < cube.size(); ++i) {
    if (!decoded[i]) return Unexpected(decoded[i].error());
    const glm::ivec2 size = decoded[i]->texture.texels.size();
    if (size.x != size.y || size != decoded[0]->texture.texels.size())
      return file.error("its faces are not square and of one size");
    cube[i] = light_of(decoded[i]->texture, intensity);
  }
  return cube;
}

}  // namespace

std::shared_ptr<const Environment> gltf_environment(const GltfFile& file, const Json& scene,
                                                    Loading& loading) {
  const Json* use = extension(&scene, kExtension);
  if (!use) return nullptr;
  const auto leave_out = [&](const std::string& why) {
    loading.warnings.add({file.path.string(), "", std::string(kExtension) + " is left out: " + why,
                          "the light of its environment is missing"});
    return nullptr;
  };
  const Json& lights = array_member(extension(file.json.get(), kExtension), "lights");
  const int index = index_member(use, "light");
  if (!in_range(index, lights)) return leave_out("it names a light that does not exist");
  const Json& light = item_of(lights, index);
  const Expected<CubeMap> cube = cube_of(file, light, loading);
  if (!cube) return leave_out(cube.error().message());
  const auto side = static_cast<std::uint64_t>((*cube)[0].width());
  // The picture and its sums of light.
  if (!loading.limit.take(file.path.string(), "the environment", 8 * side * side,
                          sizeof(glm::vec3) + sizeof(float)))
    return nullptr;
  return std::make_shared<const Environment>(lat_long_of(*cube, rotation_of(light)), file.path.string());
}

}  // namespace pinocchio
