// The system may refuse to start a thread, when a limit of processes or of memory is reached.
#pragma once

namespace pinocchio {

// The work then continues with the threads that did start, at least the calling one, and gives the same
// result. `handler` gets one line about it, once, on the thread that asked for the threads. Null, the
// default: no handler.
using ThreadWarning = void (*)(const char* line);
void set_thread_warning(ThreadWarning handler);

}  // namespace pinocchio
