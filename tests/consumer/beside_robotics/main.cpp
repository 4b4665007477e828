// Includes a header of each library.
#include <pinocchio/load.h>

#include <pinocchio/fwd.hpp>

int main() {
  const bool is_theirs = PINOCCHIO_ROBOTICS == 1;
  return is_theirs && !pinocchio::load_scene("nowhere.gltf") ? 0 : 1;
}
