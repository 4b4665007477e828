#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "pinocchio/environment.h"

namespace pinocchio {

// A value for each environment, made once and kept while the environment lives. Any thread.
template <class Value>
class MadeOfEnvironments {
 public:
  // Returns use(value). The value is a Value() at first; no other thread uses any meanwhile.
  template <class Use>
  auto with(const std::shared_ptr<const Environment>& environment, const Use& use) {
    const std::lock_guard lock(mutex_);
    std::erase_if(kept_, [](const Kept& k) { return k.of.expired(); });
    for (Kept& k : kept_)
      if (k.of.lock() == environment) return use(k.value);
    kept_.push_back({environment, Value()});
    return use(kept_.back().value);
  }

 private:
  struct Kept {
    std::weak_ptr<const Environment> of;
    Value value;
  };
  std::mutex mutex_;
  std::vector<Kept> kept_;
};

}  // namespace pinocchio
