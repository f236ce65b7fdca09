// SPDX-License-Identifier: Apache-2.0
// Reads one word of a configuration as a value. Without a .cpp, for libraries that stand alone.

#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace indurop::base {

// Reads a finite number, also with a plus before it.
inline std::optional<double> number_in(std::string_view word) noexcept {
  word.remove_prefix(word.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
  return whole ? std::optional(value) : std::nullopt;
}

// Reads true, 1, on, yes; false, 0, off, no.
inline std::optional<bool> flag_in(std::string_view word) noexcept {
  for (const std::string_view yes : {"true", "1", "on", "yes"}) {
    if (word == yes) {
      return true;
    }
  }
  for (const std::string_view no : {"false", "0", "off", "no"}) {
    if (word == no) {
      return false;
    }
  }
  return std::nullopt;
}

}  // namespace indurop::base
