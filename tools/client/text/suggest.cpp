// SPDX-License-Identifier: Apache-2.0
#include "tools/client/text/suggest.h"

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

}  // namespace indurop::tools
