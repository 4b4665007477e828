#include "core/parallel/priority.h"

#include <sys/resource.h>

namespace pinocchio {

// On Linux a thread has a niceness of its own, 19 at most, and hands it on to the threads that it starts.
void give_way(int steps) {
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + steps);
}

}  // namespace pinocchio
