// What happens where the system refuses to start a thread: a limit of processes or of memory is reached.
#pragma once

namespace pinocchio {

// The work goes on with the threads that did start, at least with the calling one, and gives the same result.
// `handler` hears of it in one line, once, on the thread that wanted the threads; null, the default: nobody
// does.
using ThreadWarning = void (*)(const char* line);
void set_thread_warning(ThreadWarning handler);

}  // namespace pinocchio
