#include <cmath>
#include <limits>

#include "pinocchio/conversion.h"
#include "python/src/scene/pickle.h"
#include "python/src/support/parts.h"

namespace pinocchio::python {
namespace {

constexpr double kMost = std::numeric_limits<float>::max(), kLeastIor = 1e-3;

Texture texture_of(const Texels& argument) {
  const auto texels = argument.read("texture");
  const std::size_t channels = texels.shape(2);
  if (channels < 3 || channels > 4 || texels.shape(0) == 0 || texels.shape(1) == 0)
    throw Error("a texture must be an array (height, width, 3 or 4) of uint8, sRGB");
  Texture texture{"", Image<glm::u8vec4>({texels.shape(1), texels.shape(0)})};
  const std::uint8_t* from = texels.data();
  for (glm::u8vec4& texel : texture.texels.pixels()) {
    texel = {from[0], from[1], from[2], channels == 4 ? from[3] : 255};
    from += channels;
  }
  return texture;
}

}  // namespace

void bind_material(nb::module_& module) {
  nb::class_<TexturedMaterial>(module, "Material",
                               "A material of Phong's model with mirrors and glass. Colours are linear, "
                               "three numbers each. It does not "
                               "change.")
      .def(
          "__init__",
          [](TexturedMaterial* self, const Three& diffuse, const Three& specular, float shininess,
             const Three& reflectance, const Three& transmittance, float ior, bool fresnel,
             const Three& emission, const std::optional<Three>& ambient, const std::optional<Texels>& texture,
             const std::string& name, float gloss, const Three& attenuation_color, float attenuation_distance,
             std::optional<bool> double_sided) {
            Material m;
            m.name = name;
            m.diffuse = diffuse.read_color("diffuse");
            m.ambient = ambient ? ambient->read_color("ambient") : m.diffuse;
            m.specular = specular.read_color("specular");
            m.shininess = number_within(shininess, "shininess", 0.0, kMost);
            m.reflectance = reflectance.read_color("reflectance");
            m.transmittance = transmittance.read_color("transmittance");
            m.ior = number_within(ior, "ior", kLeastIor, kMost);
            m.fresnel = fresnel;
            m.emission = emission.read_color("emission");
            m.gloss = number_within(gloss, "gloss", 0.0, kMost);
            m.attenuation_color = attenuation_color.read_color("attenuation_color");
            m.attenuation_distance =
                std::isinf(attenuation_distance)
                    ? 0.0f  // clear, as glTF says it
                    : number_within(attenuation_distance, "attenuation_distance", 0.0, kMost);
            m.double_sided = double_sided;
            new (self) TexturedMaterial{
                m, texture ? std::make_shared<const Texture>(texture_of(*texture)) : nullptr};
          },
          "diffuse"_a = glm::vec3(0.8f), "specular"_a = glm::vec3(0.0f), "shininess"_a = 1.0f,
          "reflectance"_a = glm::vec3(0.0f), "transmittance"_a = glm::vec3(0.0f), "ior"_a = 1.0f,
          "fresnel"_a = false, "emission"_a = glm::vec3(0.0f), "ambient"_a = nb::none(),
          "texture"_a = nb::none(), "name"_a = "", "gloss"_a = 0.0f, "attenuation_color"_a = glm::vec3(1.0f),
          "attenuation_distance"_a = 0.0f, "double_sided"_a = nb::none(),
          "diffuse, specular, ambient, emission: linear RGB. ambient: None: as diffuse.\n"
          "shininess: Phong's exponent. ior: of the inside, relative to the outside.\n"
          "reflectance: the weight of the mirrored ray; with `fresnel`, at normal incidence.\n"
          "transmittance: the weight of the refracted ray, which is refracted by `ior`.\n"
          "texture: (height, width, 3 or 4) uint8, sRGB. Its colour multiplies diffuse and ambient.\n"
          "gloss: the exponent of the lobe over which samples (spp) spread mirrored rays. 0: sharp.\n"
          "attenuation_color: the share of light that is left after `attenuation_distance` (scene units) "
          "through glass.\n"
          "attenuation_distance: 0 or inf: the glass is clear.\n"
          "double_sided: False: the camera sees through the surface from behind, unless backfaces='draw'. "
          "None: "
          "only with backfaces='cull'.\n"
          "Raises Error if a colour or the texture has another shape, or a number is negative or not finite.")
      .def_prop_ro("name", [](const TexturedMaterial& m) { return text(m.material.name); })
      .def_prop_ro("diffuse", [](const TexturedMaterial& m) { return m.material.diffuse; })
      .def_prop_ro("specular", [](const TexturedMaterial& m) { return m.material.specular; })
      .def_prop_ro("shininess", [](const TexturedMaterial& m) { return m.material.shininess; })
      .def_prop_ro("reflectance", [](const TexturedMaterial& m) { return m.material.reflectance; })
      .def_prop_ro("transmittance", [](const TexturedMaterial& m) { return m.material.transmittance; })
      .def_prop_ro("ior", [](const TexturedMaterial& m) { return m.material.ior; })
      .def_prop_ro("fresnel", [](const TexturedMaterial& m) { return m.material.fresnel; })
      .def_prop_ro("emission", [](const TexturedMaterial& m) { return m.material.emission; })
      .def_prop_ro("ambient", [](const TexturedMaterial& m) { return m.material.ambient; })
      .def_prop_ro("gloss", [](const TexturedMaterial& m) { return m.material.gloss; })
      .def_prop_ro("attenuation_color",
                   [](const TexturedMaterial& m) { return m.material.attenuation_color; })
      .def_prop_ro("attenuation_distance",
                   [](const TexturedMaterial& m) { return m.material.attenuation_distance; })
      .def_prop_ro("double_sided", [](const TexturedMaterial& m) { return m.material.double_sided; })
      .def_prop_ro(
          "roughness",
          [](const TexturedMaterial& m) {
            return m.material.is_microfacet() ? std::optional(std::sqrt(m.material.ggx_alpha)) : std::nullopt;
          },
          "glTF's roughness. None: the material is of Phong's model.")
      .def_prop_ro(
          "texture",
          [](nb::handle self)
              -> std::optional<nb::ndarray<const std::uint8_t, nb::numpy, nb::shape<-1, -1, 4>>> {
            const auto& texture = nb::cast<const TexturedMaterial&>(self).texture;
            if (!texture) return std::nullopt;
            const Image<glm::u8vec4>& texels = texture->texels;
            return nb::ndarray<const std::uint8_t, nb::numpy, nb::shape<-1, -1, 4>>(
                &texels.pixels().data()->x, {as_size(texels.height()), as_size(texels.width()), 4}, self);
          },
          "(height, width, 4) uint8, sRGB, or None. The array is not a copy.")
      .def("__repr__",
           [](const TexturedMaterial& m) {
             return "<Material " + shown(m.material.name) + ": diffuse=" + shown(m.material.diffuse) +
                    (m.texture ? ", texture" : "") + ">";
           })
      .def("__copy__", [](const TexturedMaterial& material) { return material; })
      .def(
          "__deepcopy__", [](const TexturedMaterial& material, nb::handle) { return material; }, "memo"_a)
      .def("__getstate__", [](const TexturedMaterial& material) { return pickled(material); })
      .def("__setstate__", [](TexturedMaterial& self, const nb::bytes& state) {
        TexturedMaterial read;
        unpickle(state, read);
        new (&self) TexturedMaterial(std::move(read));
      });
}

}  // namespace pinocchio::python
