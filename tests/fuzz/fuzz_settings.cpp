// A plan's JSON.
#include "hybrid/settings/json.h"
#include "pinocchio/tracer.h"
#include "tests/fuzz/input.h"

// Without the tracer, whose kernels are not built here.
bool pinocchio::isa_supported(pinocchio::Isa) {
  return true;
}
pinocchio::Isa pinocchio::default_isa() {
  return pinocchio::Isa::scalar;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)pinocchio::load_settings(pinocchio::fuzz::written("json", data, size));
  return 0;
}
