// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/debug_history.h"

#include <algorithm>
#include <iterator>

namespace indurop::tools {

void DebugHistory::add(const Answer& answer) {
  if (changes_.empty() || changes_.back().second != answer) {
    changes_.emplace_back(size_, answer);
  }
  ++size_;
}

const DebugHistory::Answer& DebugHistory::at(std::uint64_t number) const {
  const auto after = std::upper_bound(changes_.begin(), changes_.end(), number,
                                      [](std::uint64_t wanted, const auto& one) { return wanted < one.first; });
  return std::prev(after)->second;
}

std::vector<std::string> DebugHistory::sets_at(std::uint64_t number) const {
  std::vector<std::string> found;
  const auto first = std::lower_bound(sets_.begin(), sets_.end(), number,
                                      [](const auto& one, std::uint64_t wanted) { return one.first < wanted; });
  for (auto one = first; one != sets_.end() && one->first == number; ++one) {
    found.push_back(one->second);
  }
  return found;
}

void DebugHistory::cut(std::uint64_t number) {
  std::erase_if(changes_, [number](const auto& one) { return one.first >= number; });
  std::erase_if(sets_, [number](const auto& one) { return one.first >= number; });
  std::erase_if(scans_, [number](std::uint64_t scan) { return scan >= number; });
  size_ = std::min(size_, number);
}

}  // namespace indurop::tools
