#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "app/run/output.h"

namespace pinocchio::app {

// Writes frames in order, on a thread of its own, while the next ones are drawn. Where the system starts no
// thread, write() writes them.
class FrameWriter {
 public:
  // Once `cancelled` returns true, no further frame is written.
  FrameWriter(const OutputOptions& options, std::function<bool()> cancelled);
  ~FrameWriter();  // drops waiting frames
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // Waits while kMostWaiting frames are waiting. Throws what writing an earlier frame threw.
  void write(DrawnFrame frame);
  // Waits for all frames. Returns the numbers of the written ones; throws what writing one of them threw.
  std::vector<int> finish();

  static constexpr std::size_t kMostWaiting = 1;  // besides the one that is being written

 private:
  void run();
  void write_first(std::unique_lock<std::mutex>& lock);
  void end();

  const OutputOptions& options_;
  std::function<bool()> cancelled_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<DrawnFrame> waiting_;
  std::vector<int> written_;
  std::exception_ptr error_;
  bool ending_ = false;  // no frame follows
  std::thread thread_;
};

}  // namespace pinocchio::app
