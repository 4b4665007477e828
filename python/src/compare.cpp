#include <pinocchio/compare_pictures.h>
#include <pinocchio/exr.h>

#include <nanobind/stl/filesystem.h>
#include <array>
#include <cmath>

#include "pinocchio/conversion.h"
#include "python/src/result.h"
#include "python/src/support/interrupt.h"
#include "python/src/support/parts.h"

namespace pinocchio::python {
namespace {

// IEC 61966-2-1
float linear_of(std::uint8_t srgb) {
  const float c = as_float(srgb) / 255.0f;
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

template <class T, class Convert>
Image<glm::vec3> image_of(nb::handle source, const char* type, Convert convert) {
  using Picture = nb::ndarray<const T, nb::ndim<3>, nb::c_contig, nb::device::cpu>;
  const auto array = nb::cast<Picture>(array_of(source, "a picture", type, {-1, -1, -1}), false);
  const std::size_t channels = array.shape(2);
  if (channels < 3 || channels > 4) throw Error("a picture must be an array (height, width, 3 or 4)");
  Image<glm::vec3> image({array.shape(1), array.shape(0)});
  const T* from = array.data();
  for (glm::vec3& pixel : image.pixels()) {
    pixel = {convert(from[0]), convert(from[1]), convert(from[2])};
    from += channels;
  }
  return image;
}

Image<glm::vec3> image_of(nb::handle source) {
  const nb::object type = nb::module_::import_("numpy").attr("asarray")(source).attr("dtype");
  if (nb::cast<std::string>(type.attr("name")) == "uint8")
    return image_of<std::uint8_t>(source, "uint8", linear_of);
  if (nb::cast<std::string>(type.attr("kind")) == "f")
    return image_of<float>(source, "float32", [](float v) { return v; });
  throw Error("a picture has the type " + std::string(nb::str(type).c_str()) +
              "; it needs floats (linear) or uint8 (sRGB)");
}

Image<glm::vec3> image_of_exr(const std::filesystem::path& path) {
  const ExrFile exr = value_or_throw(read_exr(path));
  Image<glm::vec3> image(exr.data_window.size());
  for (int c = 0; c < 3; ++c) {
    const ExrChannel* const channel = exr.find(std::array{"R", "G", "B"}[c]);
    if (!channel || channel->type == ExrChannel::Type::uint)
      throw Error(path.string() + ": has no colours R, G and B");
    for (std::size_t i = 0; i < channel->values.size(); ++i) image[i][c] = channel->values[i];
  }
  return image;
}

Image<glm::vec3> picture_of(const nb::object& from) {
  if (nb::isinstance<Result>(from)) {
    const FrameResult& frame = nb::cast<const Result&>(from).frame;
    Image<glm::vec3> image(frame.color.size());
    for (std::size_t i = 0; i < image.pixels().size(); ++i) image[i] = glm::vec3(frame.color[i]);
    return image;
  }
  if (nb::isinstance<nb::str>(from) || nb::hasattr(from, "__fspath__"))
    return image_of_exr(nb::cast<std::filesystem::path>(from));
  return image_of(from);
}

nb::dict compare(const nb::object& a, const nb::object& b, float pixels_per_degree) {
  const Image<glm::vec3> picture = picture_of(a), reference = picture_of(b);
  auto* const found = new PictureDifference(value_or_throw(without_gil([&](Progress* progress) {
    return compare_pictures(picture, reference, pixels_per_degree, 0, progress);
  })));
  const nb::capsule owner(found, [](void* p) noexcept { delete static_cast<PictureDifference*>(p); });
  nb::dict result;
  result["rmse"] = found->rmse;
  result["relmse"] = found->relative_mse;
  result["psnr"] = found->psnr_db;
  result["max"] = found->max;
  result["flip"] = found->flip;
  result["flip_errors"] = view_of(found->flip_errors.pixels().data(),
                                  {as_size(picture.height()), as_size(picture.width())}, owner);
  return result;
}

nb::dict channels_of(const std::filesystem::path& path) {
  auto* const exr = new ExrFile(value_or_throw(without_gil([&](Progress*) { return read_exr(path); })));
  const nb::capsule owner(exr, [](void* p) noexcept { delete static_cast<ExrFile*>(p); });
  const auto size = exr->data_window.size();
  const std::initializer_list<std::size_t> shape{as_size(size.y), as_size(size.x)};
  nb::dict channels;
  for (ExrChannel& c : exr->channels) {
    if (c.type == ExrChannel::Type::uint)
      channels[c.name.c_str()] = view_of(c.uints.data(), shape, owner);
    else
      channels[c.name.c_str()] = view_of(c.values.data(), shape, owner);
  }
  return channels;
}

}  // namespace

void bind_compare(nb::module_& module) {
  module.def("compare", &compare, "a"_a, "b"_a, "pixels_per_degree"_a = 67.0f,
             nb::sig("def compare(a: Result | str | os.PathLike[str] | numpy.typing.NDArray[typing.Any], b: "
                     "Result | str | "
                     "os.PathLike[str] | numpy.typing.NDArray[typing.Any], pixels_per_degree: float = 67.0) "
                     "-> dict[str, "
                     "typing.Any]"),
             "The difference between the picture `a` and its reference `b`, as a dict: 'rmse', 'relmse', "
             "'psnr' (dB), 'max',\n"
             "'flip' (mean LDR-FLIP) and 'flip_errors' (height, width) float32, in [0, 1].\n"
             "a, b: a Result, an EXR file's path, or an array (height, width, 3 or 4): floats are linear, "
             "uint8 is sRGB.\n"
             "pixels_per_degree: pixels per degree of visual angle, 1 to 1000.\n"
             "Raises Error if the sizes differ, a value is not finite, or a file cannot be read.");
  module.def(
      "read_exr", &channels_of, "path"_a,
      nb::sig("def read_exr(path: str | os.PathLike[str]) -> dict[str, numpy.typing.NDArray[typing.Any]]"),
      "The channels of an EXR file by name, each an array (height, width): float32, or uint32 for integers.\n"
      "Raises Error if the file cannot be read.");
}

}  // namespace pinocchio::python
