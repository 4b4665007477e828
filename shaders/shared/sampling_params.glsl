// Source of GLSL and of C++ (core/shade/shared.h): which of a pixel's samples is drawn, and what it samples.

const int kSequenceSobol = 0;
const int kSequenceBlueNoise = 1;
const int kSequenceRandom = 2;
const int kSequenceZOrder = 3;

struct Sampling {
  int sequence;
  uint index;  // the sample's: 0, 1, 2, ... in every pixel
  uint seed;   // changes the picture's noise and nothing else
  uint count;  // of kSequenceZOrder: a power of two; a pixel's samples from this on are Sobol's, its own
};

// Each thing that is sampled has a dimension of its own; each bounce has as many again.
const uint kDimensionsOfBounce = 0x10000u;
const uint kLightDimension = 0u;  // the others' dimensions follow, in the scene's order
const uint kMirrorDimension = 0x8000u;
const uint kEnvironmentDimension = 0x8001u;
const uint kDiffuseDimension = 0x8002u;
const uint kLensDimension = 0x8003u;
const uint kEnvironmentChoiceDimension = 0x8005u;
