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

inline PixelType pixel_type(const LayerRow& row) {
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
