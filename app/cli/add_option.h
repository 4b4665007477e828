// Options whose text becomes a value. Anything else is a usage error that says what is wanted.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "app/cli/parse.h"

namespace pinocchio::app {

// parse: std::optional of a value that goes to `to`.
template <class Parse, class Value>
CLI::Option* add_parsed(CLI::App& verb, const std::string& name, const std::string& help,
                        const std::string& wanted, Parse parse, Value& to) {
  const auto store = [=, &to](const std::string& text) {
    const auto value = parse(text);
    if (!value) throw CLI::ValidationError(name, "'" + text + "' is not " + wanted);
    to = *value;
  };
  return verb.add_option_function<std::string>(name, store, help)->type_name(wanted);
}

// One of the names, which are in the enumeration's order.
template <class Enum, std::size_t N>
CLI::Option* add_choice(CLI::App& verb, const std::string& name, const std::string& help,
                        const std::array<std::string_view, N>& names, Enum& to) {
  const auto value_of = [names](const std::string& text) {
    const auto found = std::ranges::find(names, text);
    return found == names.end() ? std::nullopt : std::optional(static_cast<Enum>(found - names.begin()));
  };
  return add_parsed(verb, name, help, listed(names, ", ", " or "), value_of, to)
      ->type_name(listed(names, "|", "|"));
}

}  // namespace pinocchio::app
