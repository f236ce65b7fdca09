// SPDX-License-Identifier: Apache-2.0
// Values over time: what the sources of a history (the tape, recordings) find, and what a page of it consists of.

#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace indurop::tools {

// From its begin up to, but without, its end; ns since 1970.
struct TimeSpan {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;

  [[nodiscard]] bool empty() const noexcept { return begin_ns >= end_ns; }
  [[nodiscard]] bool has(std::int64_t time_ns) const noexcept { return begin_ns <= time_ns && time_ns < end_ns; }
  [[nodiscard]] TimeSpan cut_to(const TimeSpan& other) const noexcept {
    return {std::max(begin_ns, other.begin_ns), std::min(end_ns, other.end_ns)};
  }
  bool operator==(const TimeSpan&) const = default;
};

// An item had this value at this time.
struct HistoryValue {
  std::int64_t time_ns = 0;
  std::uint32_t item = 0;  // index in the request
  std::vector<std::uint8_t> bytes;
};

// The values of an item during this time are not known: they were overwritten, lost, or never recorded.
struct HistoryGap {
  std::uint32_t item = 0;
  TimeSpan span;
};

// What a source found: values by time, those of the same time in the order in which they were recorded.
struct HistoryFindings {
  std::vector<HistoryValue> values;
  std::vector<HistoryGap> gaps;
  std::int64_t complete_ns = 0;  // everything before this time was found

  void sort();
};

inline void HistoryFindings::sort() {
  std::stable_sort(values.begin(), values.end(),
                   [](const HistoryValue& a, const HistoryValue& b) { return a.time_ns < b.time_ns; });
}

}  // namespace indurop::tools
