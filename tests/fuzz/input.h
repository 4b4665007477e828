// What the fuzzers share: an input as a file, in memory where the system has such a folder.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace pinocchio::fuzz {

// That a header may claim. Small: runs a second count, and address sanitizers mark every byte.
inline constexpr std::uint64_t kMemory_bytes = std::uint64_t{4} << 20;

// A folder of this process alone, removed at its end.
inline const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path memory = "/dev/shm";
    std::filesystem::path made =
        (access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path()) /
        ("pinocchio-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    std::atexit([] { std::filesystem::remove_all(folder()); });
    return made;
  }();
  return path;
}

// The input as a file of this extension.
inline std::filesystem::path written(const std::string& extension, const std::uint8_t* data,
                                     std::size_t size) {
  const std::filesystem::path file = folder() / ("fuzz." + extension);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return file;
}

}  // namespace pinocchio::fuzz
