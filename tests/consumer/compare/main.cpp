// Succeeds if a picture differs from a brighter one, and not from itself.
#include <pinocchio/compare_pictures.h>

int main() {
  const pinocchio::Image<glm::vec3> dark({8, 8}, glm::vec3(0.25f)), bright({8, 8}, glm::vec3(0.5f));
  const auto none = compare_pictures(dark, dark), some = compare_pictures(bright, dark);
  return none && some && none->rmse == 0.0 && some->rmse == 0.25 && some->flip > 0.0 ? 0 : 1;
}
