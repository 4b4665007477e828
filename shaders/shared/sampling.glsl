// Source of GLSL and of C++ (core/shade/shared.h, core/trace/lanes/shared.h): where a pixel's samples are. All compilers
// give the same bits: the numbers are whole until the last step. Expects sampling_params.glsl.

// A hash (Ettinger's "lowbias32", with the constants of least bias).
SHARED whole mixed_bits(whole x) {
  x ^= x >> 16u;
  x *= 0x21f0aaadu;
  x ^= x >> 15u;
  x *= 0xd35a2d97u;
  return x ^ (x >> 15u);
}

SHARED whole reversed_bits(whole x) {
  x = (x >> 16u) | (x << 16u);
  x = ((x >> 8u) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8u);
  x = ((x >> 4u) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4u);
  x = ((x >> 2u) & 0x33333333u) | ((x & 0x33333333u) << 2u);
  return ((x >> 1u) & 0x55555555u) | ((x & 0x55555555u) << 1u);
}

// Owen's scrambling of a number whose bits are reversed, as a hash (Laine and Karras 2011; Vegdahl's constants):
// the lower bits alone decide whether a bit is flipped.
SHARED whole owen_scrambled(whole reversed, whole seed) {
  whole x = reversed;
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16u) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

// The second dimension of Sobol's sequence, bits reversed: Pascal's triangle modulo 2 times the index's bits.
SHARED whole sobol_second(whole index) {
  index ^= index >> 16u;
  index ^= (index >> 8u) & 0x00ff00ffu;
  index ^= (index >> 4u) & 0x0f0f0f0fu;
  index ^= (index >> 2u) & 0x33333333u;
  return index ^ ((index >> 1u) & 0x55555555u);
}

// Two dimensions at a time, the index shuffled for each pair (Burley, "Practical Hash-based Owen Scrambling",
// JCGT 9(4), 2020): any two of them are stratified, others independent.
SHARED whole2 scrambled_sobol(whole index, whole seed) {
  whole shuffled = reversed_bits(owen_scrambled(reversed_bits(index), seed));
  return whole2(reversed_bits(owen_scrambled(shuffled, mixed_bits(seed ^ 0x9e3779b9u))),
               reversed_bits(owen_scrambled(sobol_second(shuffled), mixed_bits(seed ^ 0x7f4a7c15u))));
}

// How far a pixel's points are moved around the square: neighbours far, by Roberts' R2 sequence (2018) as a
// dither mask, mirrored one of four ways for each dimension.
SHARED whole2 dither_rotation(whole2 pixel, whole way) {
  whole2 p = pick((way & 1u) != 0u, whole2(pixel.y, pixel.x), pixel);
  p = pick((way & 2u) != 0u, whole2(p.x, ~p.y), p);
  return whole2(p.x * 0xc13fa9a9u + p.y * 0x91e10da5u, p.x * 0x91e10da5u - p.y * 0xc13fa9a9u);
}

// A number's lower half, a 0 above each bit.
SHARED whole spread_bits(whole x) {
  x = (x | (x << 8u)) & 0x00ff00ffu;
  x = (x | (x << 4u)) & 0x0f0f0f0fu;
  x = (x | (x << 2u)) & 0x33333333u;
  return (x | (x << 1u)) & 0x55555555u;
}

// A pixel's place along the curve that goes through squares of 2, 4, 8 ... pixels, one after the other (Morton 1966).
SHARED whole z_order(whole2 pixel) {
  return spread_bits(pixel.x & 0xffffu) | (spread_bits(pixel.y & 0xffffu) << 1u);
}

// A pixel of the whole picture, and what its samples have in picture_seed.
struct SampledPixel {
  Sampling sampling;
  whole2 at;
  whole seed;
};

SHARED SampledPixel sampled_pixel(Sampling sampling, whole2 at) {
  SampledPixel pixel;
  pixel.sampling = sampling;
  pixel.at = at;
  pixel.seed = mixed_bits(at.x + mixed_bits(at.y + mixed_bits(sampling.seed)));
  return pixel;
}

// In [0, 1)^2.
SHARED vec2 sample_2d(SampledPixel pixel, uint dimension) {
  uint of_dimension = dimension * 0x9e3779b9u;
  whole2 bits;
  if (pixel.sampling.sequence == kSequenceZOrder && pixel.sampling.index < pixel.sampling.count) {
    // One sequence through the whole picture, so that the samples of pixels side by side are evenly spread together, in
    // each dimension by itself (Ahmed and Wonka, "Screen-space Blue-noise Diffusion of Monte Carlo Sampling Error via
    // Hierarchical Ordering of Pixels", 2020).
    whole picture_seed = mixed_bits(mixed_bits(pixel.sampling.seed) + of_dimension);
    bits = scrambled_sobol(z_order(pixel.at) * pixel.sampling.count + pixel.sampling.index, picture_seed);
  } else if (pixel.sampling.sequence == kSequenceBlueNoise) {
    // All pixels have the same points, turned by the pixel's place (Georgiev and Fajardo, "Blue-noise Dithered
    // Sampling", 2016).
    whole picture_seed = mixed_bits(mixed_bits(pixel.sampling.seed) + of_dimension);
    bits = scrambled_sobol(pixel.sampling.index, picture_seed) + dither_rotation(pixel.at, picture_seed);
  } else {
    whole own = mixed_bits(pixel.seed + of_dimension);
    if (pixel.sampling.sequence != kSequenceRandom) {
      bits = scrambled_sobol(pixel.sampling.index, own);
    } else {
      whole x = mixed_bits(own + pixel.sampling.index * 0x9e3779b9u);
      bits = whole2(x, mixed_bits(x + 0x7f4a7c15u));
    }
  }
  return vec2(bits >> 8u) * (1.0f / 16777216.0f);
}
