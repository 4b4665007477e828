#pragma once

#include <cstring>

#include "pinocchio/image.h"

namespace pinocchio {

// True for images of one size whose pixels are the same to the bit: NaNs too, and 0 is not -0.
template <class T>
bool same_bits(const Image<T>& a, const Image<T>& b) {
  if (a.size() != b.size()) return false;
  return a.pixels().empty() ||  // memcmp must not see a null pointer
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

}  // namespace pinocchio
