// Memory that counts reads, as a buffer that is mapped for writing has to be used: every access faults, the
// processor says whether it was a read, and does that one instruction. One thread at a time. x86-64 Linux.
#pragma once

#if defined(__linux__) && defined(__x86_64__)
#define PINOCCHIO_WRITE_ONLY_MEMORY
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstring>
#include <new>
#include <span>

namespace pinocchio {

class WriteOnlyMemory {
 public:
  // Filled with `pattern`.
  WriteOnlyMemory(std::size_t bytes, std::byte pattern) : bytes_(bytes) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    mapped_ = (bytes + page - 1) / page * page;
    memory_ = mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    std::memset(memory_, static_cast<int>(pattern), mapped_);
    current_ = this;
    struct sigaction action {};
    action.sa_flags = SA_SIGINFO;
    action.sa_sigaction = on_access;
    sigaction(SIGSEGV, &action, &old_access_);
    action.sa_sigaction = after_access;
    sigaction(SIGTRAP, &action, &old_trap_);
    mprotect(memory_, mapped_, PROT_NONE);
  }
  ~WriteOnlyMemory() {
    watch_no_longer();
    munmap(memory_, mapped_);
  }
  WriteOnlyMemory(const WriteOnlyMemory&) = delete;
  WriteOnlyMemory& operator=(const WriteOnlyMemory&) = delete;

  [[nodiscard]] std::span<std::byte> bytes() const { return {static_cast<std::byte*>(memory_), bytes_}; }
  [[nodiscard]] int reads() const { return reads_; }

  // What was written may be looked at from here on.
  void watch_no_longer() {
    if (!current_) return;
    mprotect(memory_, mapped_, PROT_READ | PROT_WRITE);
    sigaction(SIGSEGV, &old_access_, nullptr);
    sigaction(SIGTRAP, &old_trap_, nullptr);
    current_ = nullptr;
  }

 private:
  static constexpr greg_t kFaultWasWrite = 2, kSingleStep = 0x100;

  static void on_access(int, siginfo_t* fault, void* context) {
    auto* const begin = static_cast<std::byte*>(current_->memory_);
    auto* const at = static_cast<std::byte*>(fault->si_addr);
    if (at < begin || at >= begin + current_->mapped_) {  // a crash: it happens again, with the old action
      sigaction(SIGSEGV, &current_->old_access_, nullptr);
      return;
    }
    greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
    if ((registers[REG_ERR] & kFaultWasWrite) == 0) current_->reads_ = current_->reads_ + 1;
    mprotect(current_->memory_, current_->mapped_, PROT_READ | PROT_WRITE);
    registers[REG_EFL] |= kSingleStep;
  }
  static void after_access(int, siginfo_t*, void* context) {
    static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL] &= ~kSingleStep;
    mprotect(current_->memory_, current_->mapped_, PROT_NONE);
  }

  static inline WriteOnlyMemory* current_ = nullptr;
  std::size_t bytes_, mapped_ = 0;
  void* memory_ = nullptr;
  volatile int reads_ = 0;
  struct sigaction old_access_ {
  }, old_trap_{};
};

}  // namespace pinocchio
#endif
