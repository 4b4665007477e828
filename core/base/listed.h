#pragma once

#include <iterator>
#include <string>
#include <string_view>

namespace pinocchio {

// The names as one text: "a, b or c".
template <class Names>
[[nodiscard]] std::string listed(const Names& names, std::string_view separator, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < std::size(names); ++i)
    text.append(i == 0 ? "" : i + 1 == std::size(names) ? last : separator).append(names[i]);
  return text;
}

}  // namespace pinocchio
