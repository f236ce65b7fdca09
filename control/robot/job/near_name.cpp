// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/near_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "control/robot/job/text.h"

namespace indurop::robot {

namespace {

std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0]++;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t replaced = corner + (same_word(a.substr(i, 1), b.substr(k, 1)) ? 0 : 1);
      corner = row[k + 1];
      row[k + 1] = std::min({replaced, row[k] + 1, row[k + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string meant(std::string_view name, const std::vector<std::string>& known) {
  const std::string* best = nullptr;
  std::size_t fewest = std::min(name.size() / 3 + 2, name.size());  // excludes names that have no letter in common
  for (const std::string& one : known) {
    if (const std::size_t n = edits(name, one); n < fewest) {
      fewest = n;
      best = &one;
    }
  }
  return best == nullptr ? "" : "; did you mean '" + *best + "'?";
}

}  // namespace indurop::robot
