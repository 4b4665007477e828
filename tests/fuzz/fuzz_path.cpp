// A camera path's JSON.
#include "app/cli/errors.h"
#include "app/run/camera_path.h"
#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const pinocchio::app::CameraPath path =
        pinocchio::app::read_camera_path(pinocchio::fuzz::written("path", data, size).string(), {});
    for (const int number : {0, 1, 1000, 2'000'000'000}) (void)pinocchio::app::camera_on_path(path, number);
    (void)pinocchio::app::first_coincidence(path, {0, 2'000'000'000, 3});
  } catch (const pinocchio::app::Exit&) {  // one clear line
  }
  return 0;
}
