#include "hybrid/prepared_scene.h"

namespace pinocchio {

LitCells* PreparedScene::lit_cells() const {
  const std::lock_guard lock(cells_mutex_);
  if (!tracer || !LitCells::suits(*tracer)) return nullptr;
  if (cells_tracer_ != tracer) {
    cells_tracer_ = tracer;
    cells_.reset();
    return nullptr;
  }
  if (!cells_) cells_ = std::make_unique<LitCells>(*tracer);
  return cells_.get();
}

}  // namespace pinocchio
