// EXT_lights_image_based: a cube map around a scene, here a picture in latitude and longitude. Of its mip
// levels, each blurred for a roughness, the first is read; light is traced, so its irradianceCoefficients are
// not needed.
#include <algorithm>
#include <cmath>

#include "core/image/tonemap.h"
#include "core/math/finite.h"
#include "core/scene/cube_map.h"
#include "core/scene/gltf_file.h"
#include "core/scene/texture_file.h"

namespace pinocchio {
namespace {

constexpr const char* kExtension = "EXT_lights_image_based";

// Element `index` of an array; null where there is none.
const tinygltf::Value* element(const tinygltf::Value* array, std::optional<float> index) {
  if (!array || !array->IsArray() || !index ||
      !(*index >= 0.0f && *index < static_cast<float>(array->ArrayLen())))
    return nullptr;
  return &array->Get(static_cast<int>(*index));
}

// Of the first level: the six images' indices; none where that is not what the file says.
std::vector<int> face_images(const GltfFile& file, const tinygltf::Value& light) {
  const tinygltf::Value* faces = element(member(light, "specularImages"), 0.0f);
  if (!faces || !faces->IsArray() || faces->ArrayLen() != std::tuple_size_v<CubeMap>) return {};
  std::vector<int> images;
  for (int i = 0; i < static_cast<int>(faces->ArrayLen()); ++i) {
    const tinygltf::Value& face = faces->Get(i);
    if (!face.IsInt() || face.GetNumberAsInt() < 0 ||
        static_cast<std::size_t>(face.GetNumberAsInt()) >= file.model.images.size())
      return {};
    images.push_back(face.GetNumberAsInt());
  }
  return images;
}

glm::quat rotation_of(const tinygltf::Value& light) {
  const tinygltf::Value* r = member(light, "rotation");
  if (!r || !r->IsArray() || r->ArrayLen() != 4) return glm::quat(1, 0, 0, 0);
  const auto number = [r](int i) {
    return r->Get(i).IsNumber() ? static_cast<float>(r->Get(i).GetNumberAsDouble()) : 0.0f;
  };
  const glm::quat q(number(3), number(0), number(1), number(2));
  const float length = glm::length(q);
  return std::isfinite(length) && length > 0.0f ? q / length : glm::quat(1, 0, 0, 0);
}

// sRGB; a PNG's alpha divides it (RGBD), which is how it can be brighter than white.
Image<glm::vec3> light_of(const Texture& texture, float intensity) {
  Image<glm::vec3> light(texture.texels.size());
  for (std::size_t i = 0; i < light.pixels().size(); ++i) {
    const glm::u8vec4& t = texture.texels[i];
    const float scale = intensity * 255.0f / static_cast<float>(std::max<int>(t.a, 1));
    light[i] = scale * glm::vec3(srgb8_to_linear(t.r), srgb8_to_linear(t.g), srgb8_to_linear(t.b));
  }
  return light;
}

// An error's message where it cannot be read.
Expected<CubeMap> cube_of(const GltfFile& file, const tinygltf::Value& light, Loading& loading) {
  const std::vector<int> images = face_images(file, light);
  if (images.empty()) return file.error("its specularImages do not begin with six images");
  std::vector<EncodedImage> encoded;
  for (const int image : images) {
    Expected<EncodedImage> one = gltf_image(file, image);
    if (!one) return Unexpected(one.error());
    encoded.push_back(std::move(*one));
  }
  const float given = number_member(&light, "intensity").value_or(1.0f);
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

std::shared_ptr<const Environment> gltf_environment(const GltfFile& file, const tinygltf::Scene& scene,
                                                    Loading& loading) {
  const tinygltf::Value* use = extension(scene.extensions, kExtension);
  const tinygltf::Value* all = extension(file.model.extensions, kExtension);
  if (!use) return nullptr;
  const auto leave_out = [&](const std::string& why) {
    loading.warnings.add({file.path.string(), "", std::string(kExtension) + " is left out: " + why,
                          "the light of its environment is missing"});
    return nullptr;
  };
  const tinygltf::Value* light = element(all ? member(*all, "lights") : nullptr, number_member(use, "light"));
  if (!light) return leave_out("it names a light that there is not");
  const Expected<CubeMap> cube = cube_of(file, *light, loading);
  if (!cube) return leave_out(cube.error().message());
  const auto side = static_cast<std::uint64_t>((*cube)[0].width());
  // The picture and its sums of light.
  if (!loading.limit.take(file.path.string(), "the environment", 8 * side * side,
                          sizeof(glm::vec3) + sizeof(float)))
    return nullptr;
  return std::make_shared<const Environment>(lat_long_of(*cube, rotation_of(*light)), file.path.string());
}

}  // namespace pinocchio
