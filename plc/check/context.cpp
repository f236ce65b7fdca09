// SPDX-License-Identifier: Apache-2.0
#include "plc/check/context.h"

#include <algorithm>
#include <numeric>

namespace indurop::plc {
namespace {

// Insertions, deletions and replacements that make `a` of `b`.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  const std::string wanted = upper(name).substr(0, 100);
  std::size_t best = std::min<std::size_t>(wanted.size() / 2 + 1, 3);
  std::string_view found;
  for (const std::string& one : known) {
    const std::size_t here = distance(wanted, upper(one).substr(0, 100));
    if (here < best) {
      best = here;
      found = one;
    }
  }
  return found.empty() ? "" : ", did you mean '" + std::string(found) + "'?";
}

}  // namespace indurop::plc
