// The parameters that all readers of files share.
#pragma once

#include <cstddef>
#include <string>

#include "core/files/input_files.h"
#include "core/files/memory_limit.h"
#include "pinocchio/load.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// How points and lines become triangles, and where a file has some that do not.
struct PointsAndLines {
  struct Kind {
    float diameter = 0.0f;      // scene units; 0: they are left out
    std::string left_out_at{};  // the first place of those
    std::size_t left_out = 0;   // places

    [[nodiscard]] bool drawn() const { return diameter > 0.0f; }
    void leave_out(const std::string& where) {
      if (left_out++ == 0) left_out_at = where;
    }
  };
  Kind points{}, lines{};
  int detail = 0;  // index of kRoundDetails
};

struct Loading {
  Warnings& warnings;
  Progress* progress;  // may be null
  MemoryLimit& limit;
  InputFiles& files;  // the files beside the scene's
  const LoadOptions& options;
  PointsAndLines strokes{};
};

}  // namespace pinocchio
