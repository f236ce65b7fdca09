// SPDX-License-Identifier: Apache-2.0
// A page of a history is made from what its sources find, in the order of time: only changes are on it, and it ends
// between two times, so that the next one can begin there.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/client/history/history_position.h"
#include "tools/client/history/history_types.h"

namespace indurop::tools {

struct HistoryPage {
  std::vector<HistoryValue> values;                 // changes, by time
  std::vector<std::optional<HistoryValue>> before;  // of each item the last value before the first page, if it is known
  std::vector<HistoryGap> gaps;                     // by item and time
  std::int64_t end_ns = 0;                          // the page is complete up to, but without, this time
  std::optional<HistoryPosition> next;              // empty: it is the last page
};

// The limits of a page. All values of one time are on one page, even if they are more.
struct PageLimits {
  std::size_t values = 1000;
  std::size_t bytes = 0;
};

class PageBuilder {
 public:
  // Values before `from_ns` are not on the page; the last one of each item is its value before.
  PageBuilder(HistoryPosition start, std::int64_t from_ns, const PageLimits& limits);

  // Adds what was found from the end of the previous findings up to findings.complete_ns. Returns false if the page is
  // full.
  bool add(HistoryFindings findings);
  // The value that an item had before the page, if none was found.
  void set_before(HistoryValue value);
  [[nodiscard]] bool knows(std::uint32_t item) const noexcept { return position_.seen[item] != 0; }
  // Ends the page at its last findings: `more` if there is another one.
  HistoryPage finish(bool more);

 private:
  void take_gap(const HistoryGap& gap);
  void take_value(HistoryValue& value);
  [[nodiscard]] bool changes(const HistoryValue& value) const noexcept;
  bool end_at(std::int64_t time_ns);

  HistoryPosition position_;
  std::int64_t from_ns_;
  PageLimits limits_;
  std::size_t bytes_ = 0;
  HistoryPage page_;
};

}  // namespace indurop::tools
