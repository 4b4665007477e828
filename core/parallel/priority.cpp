#include "core/parallel/priority.h"

#include <sys/resource.h>

namespace pinocchio {

// On Linux every thread has its own niceness, at most 19, which the threads that it starts inherit.
void lower_priority(int steps) {
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + steps);
}

}  // namespace pinocchio
