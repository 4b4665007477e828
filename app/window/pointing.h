#pragma once

#include "app/window/input.h"
#include "app/window/model/pixel_report.h"

namespace pinocchio::app {

// What clicks do with the point of the scene that is under the pointer.
class Pointing {
 public:
  Pointing(Model& model, const Input& input) : model_(model), input_(input) {}

  // The camera turns around the point from now on.
  void set_pivot();
  // Its material is shown in the panel Materials.
  void pick_material();
  // The point is shown as bright as an 18 % grey card in full light.
  void expose();
  [[nodiscard]] PixelInspector& inspector() { return inspector_; }

 private:
  Model& model_;
  const Input& input_;
  PixelInspector inspector_;
};

}  // namespace pinocchio::app
