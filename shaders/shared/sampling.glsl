// Source of GLSL and of C++ (core/trace/shared.h): where a pixel's samples are, of each thing that it samples. The
// same bits on both sides: whole numbers until the last step. core/trace/lanes/sampling.h is the same in lanes.

const int kSequenceSobol = 0;
const int kSequenceBlueNoise = 1;
const int kSequenceRandom = 2;

struct Sampling {
  int sequence;
  uint index;  // of the sample: 0, 1, 2, ... in every pixel
  uint seed;   // another one: another picture of the same noise
};

// What is sampled has a dimension of its own; each bounce has as many again.
const uint kDimensionsOfBounce = 0x10000u;
const uint kLightDimension = 0u;  // and the lights that follow, in the scene's order
const uint kMirrorDimension = 0x8000u;
const uint kEnvironmentDimension = 0x8001u;
const uint kDiffuseDimension = 0x8002u;
const uint kLensDimension = 0x8003u;
const uint kFilterDimension = 0x8004u;

// A hash (Ettinger's "lowbias32", with the constants of least bias).
SHARED uint mixed_bits(uint x) {
  x ^= x >> 16u;
  x *= 0x21f0aaadu;
  x ^= x >> 15u;
  x *= 0xd35a2d97u;
  return x ^ (x >> 15u);
}

SHARED uint reversed_bits(uint x) {
  x = (x >> 16u) | (x << 16u);
  x = ((x >> 8u) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8u);
  x = ((x >> 4u) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4u);
  x = ((x >> 2u) & 0x33333333u) | ((x & 0x33333333u) << 2u);
  return ((x >> 1u) & 0x55555555u) | ((x & 0x55555555u) << 1u);
}

// Owen's scrambling of a number whose bits are reversed, as a hash (Laine and Karras 2011; Vegdahl's constants):
// each bit is flipped by those below it alone.
SHARED uint owen_scrambled(uint reversed, uint seed) {
  uint x = reversed;
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16u) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

// The second dimension of Sobol's sequence, bits reversed: Pascal's triangle modulo 2 times the index's bits.
SHARED uint sobol_second(uint index) {
  index ^= index >> 16u;
  index ^= (index >> 8u) & 0x00ff00ffu;
  index ^= (index >> 4u) & 0x0f0f0f0fu;
  index ^= (index >> 2u) & 0x33333333u;
  return index ^ ((index >> 1u) & 0x55555555u);
}

// Two dimensions at a time, the index shuffled for each pair (Burley, "Practical Hash-based Owen Scrambling",
// JCGT 9(4), 2020): any two of them are stratified, others independent.
SHARED uvec2 scrambled_sobol(uint index, uint seed) {
  uint shuffled = reversed_bits(owen_scrambled(reversed_bits(index), seed));
  return uvec2(reversed_bits(owen_scrambled(shuffled, mixed_bits(seed ^ 0x9e3779b9u))),
               reversed_bits(owen_scrambled(sobol_second(shuffled), mixed_bits(seed ^ 0x7f4a7c15u))));
}

// How far a pixel's points are moved around the square: neighbours far, by Roberts' R2 sequence (2018) as a
// dither mask, mirrored one of four ways for each dimension.
SHARED uvec2 dither_rotation(uvec2 pixel, uint way) {
  uvec2 p = (way & 1u) != 0u ? uvec2(pixel.y, pixel.x) : pixel;
  if ((way & 2u) != 0u) p.y = ~p.y;
  return uvec2(p.x * 0xc13fa9a9u + p.y * 0x91e10da5u, p.x * 0x91e10da5u - p.y * 0xc13fa9a9u);
}

SHARED uint pixel_seed(uvec2 pixel, uint seed) { return mixed_bits(pixel.x + mixed_bits(pixel.y + mixed_bits(seed))); }

// In [0, 1)^2, for the pixel of the whole picture.
SHARED vec2 sample_2d(Sampling s, uvec2 pixel, uint dimension) {
  uint of_dimension = dimension * 0x9e3779b9u;
  uvec2 bits;
  if (s.sequence == kSequenceBlueNoise) {
    // Every pixel has the same points, each turned by its place (Georgiev and Fajardo, "Blue-noise Dithered
    // Sampling", 2016).
    uint all = mixed_bits(mixed_bits(s.seed) + of_dimension);
    bits = scrambled_sobol(s.index, all) + dither_rotation(pixel, all);
  } else {
    uint own = mixed_bits(pixel_seed(pixel, s.seed) + of_dimension);
    if (s.sequence == kSequenceSobol) {
      bits = scrambled_sobol(s.index, own);
    } else {
      uint x = mixed_bits(own + s.index * 0x9e3779b9u);
      bits = uvec2(x, mixed_bits(x + 0x7f4a7c15u));
    }
  }
  return vec2(bits >> 8u) * (1.0f / 16777216.0f);
}
