// Numbers by which glTF names types and modes (OpenGL's).
#pragma once

namespace pinocchio {

// Component types of accessors.
inline constexpr int kGltfByte = 5120, kGltfUnsignedByte = 5121, kGltfShort = 5122, kGltfUnsignedShort = 5123,
                     kGltfUnsignedInt = 5125, kGltfFloat = 5126;

// Modes of primitives.
inline constexpr int kGltfPoints = 0, kGltfLines = 1, kGltfLineLoop = 2, kGltfLineStrip = 3,
                     kGltfTriangles = 4, kGltfTriangleStrip = 5, kGltfTriangleFan = 6;

// Samplers: filters and wrap modes.
inline constexpr int kGltfNearest = 9728, kGltfLinear = 9729, kGltfRepeat = 10497, kGltfClampToEdge = 33071,
                     kGltfMirroredRepeat = 33648;

}  // namespace pinocchio
