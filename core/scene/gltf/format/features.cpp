#include "core/scene/gltf/format/features.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>

#include "core/base/decimal.h"
#include "core/scene/gltf/format/constants.h"
#include "core/scene/gltf/format/json.h"
#include "core/scene/gltf/format/material_table.h"
#include "core/scene/gltf/format/variants.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

// `lost`: what the picture loses without the extension; empty: it is read, or changes no picture. `remedy`:
// what to do where a file requires it. The extensions of kSurfaceParameters and the like are read, too.
struct Extension {
  std::string_view name, lost, remedy;
};

constexpr Extension kExtensions[] = {
    {"KHR_lights_punctual", "", ""},
    {"KHR_materials_emissive_strength", "", ""},
    {"KHR_materials_unlit", "", ""},
    {"KHR_mesh_quantization", "", ""},
    {"FB_ngon_encoding", "", ""},
    {"KHR_xmp", "", ""},
    {"KHR_xmp_json_ld", "", ""},
    {"KHR_draco_mesh_compression", "", ""},
    {"EXT_meshopt_compression", "", ""},
    {"KHR_meshopt_compression", "", ""},
    {"EXT_mesh_gpu_instancing", "", ""},
    {"EXT_texture_webp", "", ""},
    {"KHR_texture_basisu", "another image or the plain colour is used",
     "convert its KTX2 images to PNG, JPEG or WebP"},
    {"MSFT_texture_dds", "another image or the plain colour is used",
     "convert its DDS images to PNG, JPEG or WebP"},
    {"EXT_texture_avif", "another image or the plain colour is used",
     "convert its AVIF images to PNG, JPEG or WebP"},
    {"KHR_texture_transform", "", ""},
    {"KHR_materials_pbrSpecularGlossiness", "", ""},
    {"KHR_materials_iridescence", "colours of thin films are missing", ""},
    {"KHR_materials_anisotropy", "highlights are round", ""},
    {"KHR_materials_dispersion", "glass does not split colours", ""},
    {"KHR_materials_diffuse_transmission", "no light shines through", ""},
    {"KHR_materials_variants", "", ""},
    {"KHR_animation_pointer", "", ""},  // what it moves in vain has a warning (gltf/animation.cpp)
    {"KHR_node_visibility", "", ""},
    {"EXT_lights_image_based", "", ""},
};

const Extension* find_extension(std::string_view name) {
  static constexpr Extension kOfMaterials{};
  if (is_in_material_table(name)) return &kOfMaterials;
  const auto* const found = std::ranges::find(kExtensions, name, &Extension::name);
  return found == std::end(kExtensions) ? nullptr : found;
}

bool is_object(const Json& json) {
  return json.is_object();
}
bool is_number(const Json& json) {
  return json.is_number();
}
template <std::size_t kCount>
bool are_numbers(const Json& json) {
  return json.is_array() && json.size() == kCount && std::all_of(json.begin(), json.end(), is_number);
}
bool is_boolean(const Json& json) {
  return json.is_boolean();
}
bool is_alpha_mode(const Json& json) {
  return json == "OPAQUE" || json == "MASK" || json == "BLEND";
}

// Members that are in none of the tables of parameters, and the types that they have to have.
struct TypedMember {
  const char* at;  // JSON pointer in a material
  bool (*fits)(const Json&);
  GltfRange range = kGltfFactor;  // of its numbers
};

bool is_in_range(const Json& numbers, const GltfRange& range) {
  if (numbers.is_array())
    return std::ranges::all_of(numbers, [&](const Json& each) { return is_in_range(each, range); });
  return !numbers.is_number() || range.has(numbers.get<float>());
}

constexpr TypedMember kTypedMembers[] = {
    {"/pbrMetallicRoughness", is_object},
    {"/pbrMetallicRoughness/baseColorFactor", are_numbers<4>},
    {"/emissiveFactor", are_numbers<3>},
    {"/extensions/KHR_materials_emissive_strength/emissiveStrength", is_number},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", are_numbers<4>},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", are_numbers<3>},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", is_number, kGltfShare},
    {"/alphaMode", is_alpha_mode},
    {"/alphaCutoff", is_number},
    {"/doubleSided", is_boolean},
    {"/extensions", is_object},
    {"/extensions/KHR_materials_volume/thicknessFactor", is_number, {0.0f, 3e38f}},
};

std::string last_name(std::string_view pointer) {
  return std::string(pointer.substr(pointer.rfind('/') + 1));
}

constexpr double kTriangles = 4.0;  // a primitive's mode, and the least of those that are triangles

double number_of(const Json& json, const std::string& key, double otherwise) {
  return value_member<double>(&json, key).value_or(otherwise);
}

// "material 'paint'", "material 3"
std::string place(const std::string& kind, const Json& of, std::size_t index) {
  const std::string name = text_member(&of, "name");
  return kind + (name.empty() ? " " + std::to_string(index) : " '" + name + "'");
}

class FeatureAudit {
 public:
  FeatureAudit(const std::filesystem::path& file, const Json& gltf, int variant, Loading& loading)
      : file_(file.string()),
        gltf_(gltf),
        variant_(variant),
        strokes_(loading.strokes),
        warnings_(loading.warnings) {}

  void run() {
    check_meshes();
    check_nodes();
    for (const auto& [collection, items] : gltf_.items()) {
      if (!items.is_array() || collection.empty()) continue;
      const std::string kind = collection == "meshes" ? "mesh" : collection.substr(0, collection.size() - 1);
      for (std::size_t i = 0; i < items.size(); ++i)
        if (collection != "materials" || used_materials_.contains(as_double(i)))
          find_extensions_in(items[i], place(kind, items[i], i));
    }
    if (const Json* extensions = member(&gltf_, "extensions")) check_extensions(*extensions, "");
    const Json& materials = array_member(&gltf_, "materials");
    for (std::size_t i = 0; i < materials.size(); ++i)
      if (used_materials_.contains(as_double(i)))
        check_material(i, materials[i], place("material", materials[i], i));
    check_scenes();
  }

 private:
  void lost(const std::string& where, std::string_view what, std::string_view loss) {
    warnings_.add({file_, where, std::string(what), std::string(loss)});
  }

  void find_extensions_in(const Json& json, const std::string& where) {
    if (json.is_array())
      for (const Json& element : json) find_extensions_in(element, where);
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items()) {
      if (key == "extensions") check_extensions(value, where);
      if (key != "extras") find_extensions_in(value, where);
    }
  }

  void check_extensions(const Json& extensions, const std::string& where) {
    if (!extensions.is_object()) return;
    for (const auto& [name, value] : extensions.items()) {
      const Extension* known = find_extension(name);
      if (!known) lost(where, name + " is left out", "what this extension adds is missing");
      if (known && !known->lost.empty()) lost(where, name + " is left out", known->lost);
    }
  }

  void check_meshes() {
    const Json& meshes = array_member(&gltf_, "meshes");
    for (const Json& mesh : meshes)
      for (const Json& primitive : array_member(&mesh, "primitives")) {
        const double material = material_in_variant(primitive, variant_);
        used_materials_.insert(material);
        const double mode = number_of(primitive, "mode", kTriangles);
        if (mode < kTriangles && !(mode == kGltfPoints ? strokes_.points : strokes_.lines).drawn()) continue;
        const Json* attributes = member(&primitive, "attributes");
        for (std::size_t set = 0; set < uncovered_.size(); ++set)
          if (!attributes || !attributes->contains("TEXCOORD_" + std::to_string(set)))
            uncovered_[set].insert(material);
      }
  }

  void check_nodes() {
    constexpr std::pair<const char*, std::size_t> kPlaces[] = {
        {"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}};
    const Json& nodes = array_member(&gltf_, "nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (const auto& [key, count] : kPlaces)
        if (member(&nodes[i], key) && numbers_member(&nodes[i], key).size() != count)
          lost(place("node", nodes[i], i),
               std::string("its ") + key + " is left out, as it is not " + std::to_string(count) + " numbers",
               "it may be in the wrong place");
  }

  void check_material(std::size_t index, const Json& material, const std::string& where) {
    const auto wrong_type = [&](std::string_view at) {
      lost(where, "its " + last_name(at) + " has the wrong type", "the default is used");
    };
    const auto clamped = [&](std::string_view at, const GltfRange& range) {
      lost(where,
           "its " + last_name(at) + " is not between " + shortest(range.least) + " and " +
               shortest(range.most),
           "the nearest allowed value is used");
    };
    for (const TypedMember& row : kTypedMembers) {
      const Json* const value = find_at(&material, row.at);
      if (!value) continue;
      if (!row.fits(*value))
        wrong_type(row.at);
      else if (!is_in_range(*value, row.range))
        clamped(row.at, row.range);
    }
    Material unused;
    GltfSurface surface;
    for (const std::span<const GltfParameter> rows : {std::span<const GltfParameter>(kPhongParameters),
                                                      std::span<const GltfParameter>(kSurfaceParameters),
                                                      std::span<const GltfParameter>(kVolumeParameters)})
      for (const GltfParameter& row : rows) {
        const GltfValue value = read_gltf_parameter(material, row, unused, surface);
        if (value == GltfValue::wrong_type) wrong_type(row.at);
        if (value == GltfValue::clamped) clamped(row.at, row.range);
      }
    for (const GltfTexture& row : kGltfTextures) {
      const Json* const texture = find_at(&material, row.at);
      if (!texture) continue;
      check_texture(index, *texture, "its " + last_name(row.at), where);
      const Json* const factor = row.factor ? member(texture, row.factor) : nullptr;
      if (factor && !factor->is_number())
        wrong_type(row.factor);
      else if (factor && !is_in_range(*factor, row.factor_range))
        clamped(row.factor, row.factor_range);
    }
    const Json* const of_coat =
        find_at(&material, "/extensions/KHR_materials_clearcoat/clearcoatNormalTexture");
    const Json* const of_base = member(&material, "normalTexture");
    if (of_coat && !(of_base && number_of(*of_coat, "index", -1) == number_of(*of_base, "index", -2)))
      lost(where, "the normal map of its clear coat is left out", "the coat is smooth");
  }

  void check_texture(std::size_t material, const Json& info, const std::string& which,
                     const std::string& where) {
    const Json* texture = element_of("textures", number_of(info, "index", -1));
    if (!texture || !has_image(*texture))
      lost(where, which + " names an image that does not exist",
           "surfaces that it should cover have one colour");
    const Json* extensions = member(&info, "extensions");
    const Json* transform = member(extensions, "KHR_texture_transform");
    if (transform && !transform->is_object())
      lost(where, which + "'s KHR_texture_transform is not an object",
           "its texture is placed as if there were none");
    const double usual = number_of(info, "texCoord", 0),
                 set = transform ? number_of(*transform, "texCoord", usual) : usual;
    if (set > 1)
      lost(where, "texture coordinates beyond the second set are left out",
           "its texture lies as the first set says");
    if (uncovered_[set == 1 ? 1 : 0].contains(as_double(material)))
      lost(where, which + " lies on triangles without texture coordinates", "it has one colour there");
  }

  // An extension that is not read counts as an image: it has a warning of its own.
  [[nodiscard]] bool has_image(const Json& texture) const {
    if (element_of("images", number_of(texture, "source", -1))) return true;
    const Json* extensions = member(&texture, "extensions");
    const Json* webp = member(extensions, "EXT_texture_webp");
    return webp ? element_of("images", number_of(*webp, "source", -1)) != nullptr : extensions != nullptr;
  }

  [[nodiscard]] const Json* element_of(const std::string& collection, double index) const {
    const Json& items = array_member(&gltf_, collection);
    return index >= 0 && index < items.size() ? &items[as_size(index)] : nullptr;
  }

  void check_scenes() {
    const Json& scenes = array_member(&gltf_, "scenes");
    const double named = number_of(gltf_, "scene", 0);
    const std::size_t shown = element_of("scenes", named) ? as_size(named) : 0;
    for (std::size_t i = 0; i < scenes.size(); ++i)
      if (i != shown)
        lost(place("scene", scenes[i], i), "scenes other than the default one are left out",
             "what they hold is not drawn");
  }

  std::string file_;
  const Json& gltf_;
  int variant_;
  const PointsAndLines& strokes_;
  Warnings& warnings_;
  std::set<double> used_materials_;
  // Materials of triangles that lack that set of texture coordinates.
  std::array<std::set<double>, 2> uncovered_;
};

}  // namespace

Expected<void> check_gltf_requirements(const std::filesystem::path& file, const Json& gltf) {
  const auto fail = [&file](const std::string& what, const std::string& remedy) {
    return Unexpected(InputError{file.string(), 0, what, remedy});
  };
  const Json* asset = member(&gltf, "asset");
  const std::string version = text_member(asset, "version");
  if (version.empty())
    return fail("is not glTF: it does not say its version (asset.version)", "is the export complete?");
  if (!version.starts_with("2."))
    return fail("is glTF " + version + ", only 2.0 can be read", "convert it to glTF 2.0");
  const std::string least = text_member(asset, "minVersion");
  if (!least.empty() && least != "2.0")
    return fail("needs a reader of glTF " + least + ", this one reads 2.0", "export it as glTF 2.0");
  for (const Json& required : array_member(&gltf, "extensionsRequired")) {
    const std::string name = required.is_string() ? required.get<std::string>() : required.dump();
    const Extension* known = find_extension(name);
    if (known && known->lost.empty()) continue;
    return fail("requires the extension " + name + ", which is not supported",
                known && !known->remedy.empty() ? std::string(known->remedy) : "export it without");
  }
  return {};
}

void add_lost_gltf_features(const std::filesystem::path& file, const Json& gltf, int variant,
                            Loading& loading) {
  FeatureAudit(file, gltf, variant, loading).run();
}

}  // namespace pinocchio
