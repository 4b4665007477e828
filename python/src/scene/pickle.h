// Scenes and their parts as bytes, for pickle. The bytes are read by the version that wrote them.
#pragma once

#include "python/src/scene/scene.h"

namespace pinocchio::python {

[[nodiscard]] nb::bytes pickled(const Scene& scene);
[[nodiscard]] nb::bytes pickled(const Camera& camera);
[[nodiscard]] nb::bytes pickled(const Light& light);
[[nodiscard]] nb::bytes pickled(const TexturedMaterial& material);

// Throw Error if the bytes are of another version or damaged.
void unpickle(const nb::bytes& bytes, Scene& scene);
void unpickle(const nb::bytes& bytes, Camera& camera);
void unpickle(const nb::bytes& bytes, Light& light);
void unpickle(const nb::bytes& bytes, TexturedMaterial& material);

}  // namespace pinocchio::python
