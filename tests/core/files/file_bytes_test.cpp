#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <numeric>
#include <thread>

#include "core/files/base64.h"
#include "core/files/input_file.h"
#include "core/parallel/parts.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

std::string decoded(std::string_view text) {
  return std::string(decode_base64(text).text());
}

TEST(Base64, IsWhatRfc4648Says) {
  EXPECT_EQ(decoded(""), "");
  EXPECT_EQ(decoded("Zg=="), "f");
  EXPECT_EQ(decoded("Zm8="), "fo");
  EXPECT_EQ(decoded("Zm9v"), "foo");
  EXPECT_EQ(decoded("Zm9vYg"), "foob");  // without padding
  EXPECT_EQ(decoded("Zm9vYmFy"), "foobar");
}

TEST(Base64, OfManyPartsAndWithLineEndsIsTheSame) {
  std::string text, bytes;
  while (text.size() < 5'000'000) {
    text += "Zm9vYmFyZm9v";
    bytes += "foobarfoo";
  }
  EXPECT_EQ(decoded(text), bytes);
  text += "YmE=";
  bytes += "ba";
  EXPECT_EQ(decoded(text), bytes);
  for (const std::size_t at : {std::size_t{3}, text.size() / 2, text.size() - 2}) {
    std::string broken = text;
    broken.insert(at, "\r\n");
    EXPECT_EQ(decoded(broken), bytes) << at;
  }
}

TEST(InputFile, IsReadInPartsAsItIs) {
  std::string bytes(9'000'001, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i ^ i >> 8 ^ i >> 16);
  const std::filesystem::path file = own_file("bytes.bin");
  std::ofstream(file, std::ios::binary) << bytes;
  Progress progress;
  const Expected<FileBytes> read = read_input_file(file, &progress);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->text(), bytes);
  EXPECT_EQ(progress.fraction(), 1.0);
  progress.cancel();
  EXPECT_THROW((void)read_input_file(file, &progress), Cancelled);
}

// Until the other thread was quick enough to cut the file within a reading of it.
TEST(InputFile, ThatBecomesShorterWhileItIsReadIsAnError) {
  constexpr std::uintmax_t kBytes = std::uintmax_t{64} << 20;
  const std::filesystem::path file = own_file("shrinking.bin");
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::ofstream(file, std::ios::binary) << "x";
    std::filesystem::resize_file(file, kBytes);
    Progress progress;
    std::atomic<bool> done = false;
    std::thread other([&] {
      while (progress.fraction() == 0.0 && !done) continue;
      std::filesystem::resize_file(file, 1);
    });
    const Expected<FileBytes> read = read_input_file(file, &progress);
    done = true;
    other.join();
    if (read) {
      EXPECT_EQ(read->size(), kBytes);
      continue;
    }
    EXPECT_EQ(read.error().message(),
              file.string() + ": became shorter while it was read; is another program writing it?");
    return;
  }
  FAIL() << "the file was always read before it became shorter";
}

FileBytes in_memory(std::string_view text) {
  FileBytes bytes(text.size());
  std::ranges::copy(text, bytes.begin());
  return bytes;
}

TEST(InputFile, TextBecomesUtf8) {
  using namespace std::string_view_literals;
  EXPECT_EQ(as_utf8(in_memory("plain")).text(), "plain");
  EXPECT_EQ(as_utf8(in_memory("\xef\xbb\xbfmarked")).text(), "marked");
  EXPECT_EQ(as_utf8(in_memory("\xff\xfe\xe4\0b\0"sv)).text(),
            "\xc3\xa4"
            "b");
  EXPECT_EQ(as_utf8(in_memory("\xfe\xff\0\xe4\0b"sv)).text(),
            "\xc3\xa4"
            "b");
  EXPECT_EQ(as_utf8(in_memory("\xff\xfe")).text(), "");
}

TEST(Parts, FindTheFirst) {
  std::vector<int> numbers(1'000'000);
  std::iota(numbers.begin(), numbers.end(), 0);
  for (const int least : {0, 131'071, 131'072, 700'000, 999'999, 1'000'000})
    EXPECT_EQ(first_where(numbers.size(), [&](std::size_t i) { return numbers[i] >= least; }),
              static_cast<std::size_t>(least));
  EXPECT_EQ(first_where(0, [](std::size_t) { return true; }), 0u);
}

}  // namespace
}  // namespace pinocchio
