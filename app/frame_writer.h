#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "app/output.h"

namespace pinocchio::app {

// Writes frames in the order they are given, on a thread of its own, while the next ones are drawn. Where the
// system starts no thread, write() does it.
class FrameWriter {
 public:
  // `cancelled` is asked before each frame; from the first yes on, nothing more is begun.
  FrameWriter(const OutputOptions& options, std::function<bool()> cancelled);
  ~FrameWriter();  // what is not begun by then is dropped
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // Waits while kMostWaiting frames are. Throws what the writing of an earlier frame threw.
  void write(DrawnFrame frame);
  // Waits for all of them. The numbers of the frames that are written; throws what writing one of them threw.
  std::vector<int> finish();

  static constexpr std::size_t kMostWaiting = 1;  // beside the one that is being written

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
