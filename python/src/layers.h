#pragma once

#include <pinocchio/frame_arrays.h>

#include <string>
#include <type_traits>

#include "python/src/support/parts.h"

namespace pinocchio::python {

// A pixel's numbers in a layer's array.
struct PixelType {
  nb::dlpack::dtype type;
  const char* name;            // the type's name
  std::size_t bytes, numbers;  // of a number; numbers of a pixel
};

// Of a mask with so many bytes a pixel: one number, or numbers of 64 bits.
inline PixelType mask_type(std::size_t bytes) {
  switch (bytes) {
    case 1:
      return {nb::dtype<std::uint8_t>(), "uint8", 1, 1};
    case 2:
      return {nb::dtype<std::uint16_t>(), "uint16", 2, 1};
    case 4:
      return {nb::dtype<std::uint32_t>(), "uint32", 4, 1};
    default:
      return {nb::dtype<std::uint64_t>(), "uint64", 8, bytes / 8};
  }
}

// mask_bytes: FrameArrays::mask_bytes.
inline PixelType pixel_type(const LayerRow& row, std::size_t mask_bytes = 1) {
  if (row.layer == Layer::mask) return mask_type(mask_bytes);
  return std::visit(
      [](auto member) -> PixelType {
        if constexpr (std::is_same_v<decltype(member), std::monostate>) {
          return {nb::dtype<float>(), "float32", sizeof(float), 0};
        } else {
          using Pixel = std::remove_reference_t<decltype(*(FrameArrays{}.*member))>;
          if constexpr (std::is_integral_v<Pixel>)
            return {nb::dtype<Pixel>(), sizeof(Pixel) == 1 ? "uint8" : "uint32", sizeof(Pixel), 1};
          else
            return {nb::dtype<float>(), "float32", sizeof(float), sizeof(Pixel) / sizeof(float)};
        }
      },
      row.array.values);
}

// Sets the array that the layer is written to.
inline void point(const LayerRow& row, void* data, FrameArrays& to) {
  std::visit(
      [&](auto member) {
        if constexpr (!std::is_same_v<decltype(member), std::monostate>)
          to.*member = static_cast<std::remove_reference_t<decltype(to.*member)>>(data);
      },
      row.array.values);
}

// "(h, w, 3) float32: world shading normal, unit."
inline std::string doc_of(Layer layer) {
  const LayerRow& row = layer_row(layer);
  const PixelType type = pixel_type(row);
  return "(h, w" + (type.numbers > 1 ? ", " + std::to_string(type.numbers) : "") + ") " + type.name + ": " +
         std::string(row.array.doc) + ".";
}

// The names of all arrays, separated by commas.
inline std::string array_names() {
  std::string names;
  for (const LayerRow& row : kLayers)
    if (!row.array.name.empty()) names += (names.empty() ? "" : ", ") + std::string(row.array.name);
  return names;
}

}  // namespace pinocchio::python
