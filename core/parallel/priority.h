#pragma once

namespace pinocchio {

// Steps of niceness. With five, a thread gets a quarter of the processor's time beside a thread with none
// (sched(7)).
inline constexpr int kForFrames = 5;       // for a window's frames and loading: input comes first
inline constexpr int kForBackground = 19;  // for work that nobody waits for: frames come first

// Lowers the priority of the calling thread and of the threads that it starts from now on. A thread cannot
// raise its priority again.
void lower_priority(int steps);

}  // namespace pinocchio
