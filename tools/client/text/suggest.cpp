// SPDX-License-Identifier: Apache-2.0
#include "tools/client/text/suggest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "core/base/nearest.h"

namespace indurop::tools {

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
  std::string found = base::nearest(word, known);
  if (found.empty() && word.size() >= 2) {
    std::size_t matches = 0;
    for (const auto& candidate : known) {
      if (candidate.starts_with(word)) {
        ++matches;
        found = candidate;
      }
    }
    if (matches != 1) {
      found.clear();
    }
  }
  return found.empty() ? std::string{} : " Did you mean '" + found + "'?";
}

std::vector<std::string> variables_named(std::string_view typed, std::span<const std::string> names) {
  std::string full;
  for (const char c : typed) {
    full += c == '.' ? "::" : std::string(1, c);
  }
  if (std::find(names.begin(), names.end(), full) != names.end()) {
    return {full};
  }
  std::vector<std::string> meant;
  std::copy_if(names.begin(), names.end(), std::back_inserter(meant),
               [&](const std::string& name) { return name.ends_with("::" + full); });
  return meant;
}

std::string which_variable(std::string_view typed, std::span<const std::string> meant) {
  return fmt::format("'{}' may be '{}'; write the namespace too", typed, fmt::join(meant, "', '"));
}

}  // namespace indurop::tools
