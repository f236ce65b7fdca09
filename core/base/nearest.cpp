// SPDX-License-Identifier: Apache-2.0
// Edit distance with swaps (optimal string alignment), cut off where a suggestion would no longer help.

#include "core/base/nearest.h"

#include <algorithm>
#include <vector>

namespace indurop::base {
namespace {

constexpr std::size_t kLongestName = 256;  // longer names get no suggestion

char lower(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_up(b.size() + 1);
  std::vector<std::size_t> up(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    up[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({up[j] + 1, row[j - 1] + 1, up[j - 1] + (same ? 0U : 1U)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
        row[j] = std::min(row[j], two_up[j - 2] + 1);
      }
    }
    std::swap(two_up, up);
    std::swap(up, row);
  }
  return up[b.size()];
}

}  // namespace

std::string nearest(std::string_view name, std::span<const std::string> candidates) {
  if (name.empty() || name.size() > kLongestName) {
    return {};
  }
  std::size_t best = std::max<std::size_t>(1, name.size() / 3) + 1;  // the best must have fewer edits than this
  const std::string* found = nullptr;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(name.size(), candidate.size());
    const std::size_t shorter = std::min(name.size(), candidate.size());
    if (longer - shorter >= best) {
      continue;
    }
    // Replacing every letter is no similarity: "a" is not near "b".
    const std::size_t edits = distance(name, candidate);
    if (edits < best && edits < longer) {
      best = edits;
      found = &candidate;
    }
  }
  return found == nullptr ? std::string() : *found;
}

}  // namespace indurop::base
