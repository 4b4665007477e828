// Work with each of its allocations failing in turn, and what saving leaves then.
#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>
#include <new>

#include "pinocchio/save.h"
#include "tests/support/failing_allocator.h"
#include "tests/support/own_file.h"

namespace pinocchio {

// Runs `work` with each of its allocations failing in turn, until it needs no more; it may throw
// std::bad_alloc alone, and leaves nothing behind.
template <class Work, class Check>
void fail_each_allocation(const Work& work, const Check& check) {
  work();  // what lives as long as the program is made
  constexpr long kMost = 100'000;
  for (long n = 1; n < kMost; ++n) {
    const long made = allocations_made, alive = blocks_alive;
    fail_allocation(n);
    try {
      work();
    } catch (const std::bad_alloc&) {
    }
    fail_allocation(0);
    ASSERT_EQ(blocks_alive, alive) << "a block leaks where allocation " << n << " fails";
    ASSERT_NO_FATAL_FAILURE(check()) << "where allocation " << n << " fails";
    if (allocations_made - made < n) {
      EXPECT_GT(n, 5);
      return;
    }
  }
  FAIL() << "it never ends";
}

inline void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The file that stands there stays, or is replaced by all of the new one; no other file is left.
inline void save_whole_or_not(const Scene& scene, const std::string& name,
                              const std::vector<std::string>& written) {
  save_scene(scene, own_file(name));
  std::vector<std::string> whole;
  for (const std::string& file : written) whole.push_back(text_of(own_file(file)));
  const std::string before = "what stood there";
  fail_each_allocation(
      [&] {
        Warnings warnings;
        save_scene(scene, own_file(name), nullptr, &warnings);
      },
      [&] {
        for (std::size_t i = 0; i < written.size(); ++i) {
          const std::string now = text_of(own_file(written[i]));
          ASSERT_TRUE(now == whole[i] || now == before) << written[i];
          write(own_file(written[i]), before);
        }
        for (const std::filesystem::directory_entry& entry :
             std::filesystem::directory_iterator(own_folder()))
          ASSERT_NE(std::ranges::find(written, entry.path().filename().string()), written.end())
              << entry.path();
      });
}

}  // namespace pinocchio
