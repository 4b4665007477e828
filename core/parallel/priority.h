#pragma once

namespace pinocchio {

// Steps of niceness; five are a quarter of the processor's time beside a thread that gives way by none
// (sched(7)).
inline constexpr int kForFrames =
    5;  // what a window's frames are made of, and scenes that it reads: input first
inline constexpr int kForBackground = 19;  // what nobody waits for: frames first

// The calling thread, and those that it starts from now on, leave the processor to those that are less nice.
// For good: a thread may not take its priority back.
void give_way(int steps);

}  // namespace pinocchio
