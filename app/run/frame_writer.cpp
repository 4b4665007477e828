#include "app/run/frame_writer.h"

#include <utility>

#include "core/parallel/start_thread.h"

namespace pinocchio::app {

FrameWriter::FrameWriter(const OutputOptions& options, std::function<bool()> cancelled)
    : options_(options),
      cancelled_(std::move(cancelled)),
      thread_(start_thread<std::thread>([this] { run(); })) {}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
  }
  end();
}

void FrameWriter::write(DrawnFrame frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting || error_; });
  if (error_) std::rethrow_exception(error_);
  waiting_.push_back(std::move(frame));
  if (!thread_.joinable()) return write_first(lock);
  changed_.notify_all();
}

std::vector<int> FrameWriter::finish() {
  end();
  if (error_) std::rethrow_exception(error_);
  return written_;
}

void FrameWriter::end() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FrameWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    write_first(lock);
  }
}

void FrameWriter::write_first(std::unique_lock<std::mutex>& lock) {
  const DrawnFrame frame = std::move(waiting_.front());
  waiting_.pop_front();
  changed_.notify_all();
  if (error_ || cancelled_()) return;
  lock.unlock();
  try {
    write_outputs(options_, frame);
    lock.lock();
    written_.push_back(frame.header.number);
  } catch (...) {
    if (!lock.owns_lock()) lock.lock();
    error_ = std::current_exception();
  }
  changed_.notify_all();
}

}  // namespace pinocchio::app
