#include "core/files/base64.h"

#include <array>
#include <atomic>
#include <cstdint>

#include "core/parallel/parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::uint32_t kNoLetter = 0x80000000u;

// A letter's value at each of the four places in 24 bits.
constexpr std::array<std::array<std::uint32_t, 256>, 4> kLetterValues = [] {
  std::array<std::array<std::uint32_t, 256>, 4> values{};
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t place = 0; place < 4; ++place) {
    values[place].fill(kNoLetter);
    for (std::size_t i = 0; i < kLetters.size(); ++i)
      values[place][static_cast<unsigned char>(kLetters[i])] = as_uint32(i) << (18 - 6 * place);
  }
  return values;
}();

std::uint32_t bits_of(char letter, std::size_t place) {
  return kLetterValues[place][static_cast<unsigned char>(letter)];
}

// Decodes groups of four letters to three bytes each. False: there are other characters.
bool decode_groups(std::string_view text, char* to) {
  for (const char *from = text.data(), *const end = from + text.size(); from != end; from += 4, to += 3) {
    const std::uint32_t bits =
        bits_of(from[0], 0) | bits_of(from[1], 1) | bits_of(from[2], 2) | bits_of(from[3], 3);
    if (bits >= kNoLetter) return false;
    to[0] = bits >> 16;
    to[1] = bits >> 8;
    to[2] = bits;
  }
  return true;
}

// Decodes letter by letter. Returns the end of the bytes.
char* decode_letters(std::string_view text, char* to) {
  std::uint32_t bits = 0;
  int count = 0;  // letters that are not yet whole bytes
  for (const char letter : text) {
    const std::uint32_t value = bits_of(letter, 3);
    if (value == kNoLetter) continue;
    bits = bits << 6 | value;
    count = (count + 1) % 4;
    if (count != 1) *to++ = bits >> (6 - 2 * ((count + 3) % 4));
  }
  return to;
}

}  // namespace

FileBytes decode_base64(std::string_view text) {
  constexpr std::size_t kGroupsAtOnce = std::size_t{1} << 18;
  FileBytes bytes(text.size() / 4 * 3 + 3);
  // All groups but the last, which may be padded, have only letters, unless there are line ends.
  const std::size_t groups = text.empty() ? 0 : (text.size() - 1) / 4;
  std::atomic<bool> plain = true;
  for_each_part(groups, kGroupsAtOnce, [&](std::size_t first, std::size_t last) {
    if (plain && !decode_groups(text.substr(4 * first, 4 * (last - first)), bytes.data() + 3 * first))
      plain = false;
  });
  const std::size_t done = plain ? groups : 0;
  const char* const end = decode_letters(text.substr(4 * done), bytes.data() + 3 * done);
  bytes.drop_back(bytes.size() - (end - bytes.data()));
  return bytes;
}

}  // namespace pinocchio
