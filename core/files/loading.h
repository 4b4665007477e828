// The parameters that all readers of files share.
#pragma once

#include "core/files/input_files.h"
#include "core/files/memory_limit.h"
#include "pinocchio/load.h"
#include "pinocchio/progress.h"

namespace pinocchio {

struct Loading {
  Warnings& warnings;
  Progress* progress;  // may be null
  MemoryLimit& limit;
  InputFiles& files;  // the files beside the scene's
  Shading shading = Shading::from_file;
  std::string animation{};  // LoadOptions'
};

}  // namespace pinocchio
