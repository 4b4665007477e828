// Source of GLSL and of C++ (core/shade/shared.h): how textures are averaged.

const int kMostTaps = 8;  // in a pixel's footprint
// The shares of a tap's texels are whole numbers and add up to this, so that the sums of 8-bit texels are exact,
// whatever the order: 8 * 8192 * 255 is below 2^24, and floats are exact up to there. (Hardware filters with 8 bits of
// share, and GPU and CPU would differ.)
const float kWholeShare = 8192.0f;
const float kLongestFootprint = 1.0e18f;  // in texels: beyond it, its square is not a finite number
