#pragma once

#include <filesystem>

#include "hybrid/composite_pass.h"
#include "hybrid/flight.h"
#include "hybrid/visibility_pass.h"

namespace pinocchio {

// What is done to a frame, one function a step; the order is hybrid/frame.cpp's. None waits for the GPU
// but fetch_ids and the last three.
class Steps {
 public:
  Steps(Workers& workers, const std::filesystem::path& shaders);

  // GPU: which triangle each pixel sees; where the plan traces, the ids set out for the CPU.
  void draw_visibility(Flight& frame) const;
  // Takes the ids and opens the buffers that the CPU's answer will travel in.
  void fetch_ids(Flight& frame) const;
  // CPU, on any thread: shadow mask and reflection, written where they travel.
  void trace(Flight& frame) const;
  // Sends them off.
  void upload(Flight& frame) const;
  // GPU: Phong per light times its mask bit, plus reflection.
  void composite(Flight& frame);

  // The finished picture on the CPU, linear RGBA; waits for the GPU.
  void read_picture(Flight& frame, Image<glm::vec4>& color) const;
  // Flight::ids, also where the plan needs none on the CPU; waits for the GPU.
  void read_ids(Flight& frame) const;
  // Fills in what only the GPU's clock knows; waits for the GPU.
  void complete_record(Flight& frame);

 private:
  Workers& workers_;
  VisibilityPass visibility_;
  CompositePass composite_;
  gl::GpuClock clock_;
};

}  // namespace pinocchio
