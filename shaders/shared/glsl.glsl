// What the shared sources are written over, in GLSL: one point at a time. C++ has it over GLM (core/shade/shared_material.h)
// and over lanes (core/trace/lanes/shared.h), where `real`, `boolean`, `whole` and vectors are a packet of points and
// float, bool, int and uint are the same for all of them. READ_ONLY: a parameter that the function leaves as it is, which
// C++ has by reference; a packet's material is 2 KB.

#define SHARED
#define READ_ONLY(type) type
#define real float
#define boolean bool
#define whole uint
#define whole2 uvec2
#define pick(condition, yes, no) ((condition) ? (yes) : (no))
#define any(condition) (condition)
#define none() false
