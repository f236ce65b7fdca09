// SPDX-License-Identifier: Apache-2.0
// The module that had a core at each time, from begins and ends of runs. Of nested runs the innermost has the core.
// Pure.

#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "history/explain/facts.h"

namespace indurop::explain {

inline constexpr std::uint32_t kNoModule = UINT32_MAX;

struct Span {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  [[nodiscard]] std::int64_t length() const noexcept { return to_ns > from_ns ? to_ns - from_ns : 0; }
};

// The time that each module had the core within a span; kNoModule: no run of the node.
using Shares = std::map<std::uint32_t, std::int64_t>;

class Timeline {
 public:
  // The facts are borrowed. `core`: as in ModuleFact.
  Timeline(const Facts& facts, std::int32_t core);

  [[nodiscard]] Shares shares(Span span) const;
  // Returns the run that had the core at a time; null: none.
  [[nodiscard]] const RunFact* at(std::int64_t time_ns) const;

 private:
  std::vector<const RunFact*> runs_;  // by start
  std::int64_t longest_ns_ = 0;
};

}  // namespace indurop::explain
