// States in which a program may leave OpenGL before it has frames drawn in its context.
#pragma once

#include <functional>
#include <ostream>
#include <vector>

#include "gl/context/functions.h"

namespace pinocchio {

struct Hostile {
  const char* name;
  std::function<void()> set;
  int since = 33;  // OpenGL's version

  friend void PrintTo(const Hostile& state, std::ostream* to) { *to << state.name; }  // for GoogleTest
};

[[nodiscard]] const std::vector<Hostile>& hostile_states();

// Names that these make live as long as their context.
void bind_framebuffers();  // one to draw to and one to read from
void use_program_with_subroutine();

void enable_all(const std::vector<GLenum>& names);

}  // namespace pinocchio
