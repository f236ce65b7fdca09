// SPDX-License-Identifier: Apache-2.0
// The part of a history that is on the tape of a node. Only reads: the node is not affected. Not real-time safe; one
// thread at a time.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "store/tape/follower.h"
#include "store/vars/store.h"
#include "tools/client/history/history_items.h"
#include "tools/client/history/history_types.h"
#include "tools/client/node/run_view.h"

namespace indurop::tools {

class TapeHistory {
 public:
  struct Wanted {
    std::vector<HistoryItem> items;
    TimeSpan span;                        // of earlier values, only each item's last one is kept
    std::int64_t real_minus_node_ns = 0;  // CLOCK_REALTIME minus the node's time
  };
  // Returns nothing if the node has no tape, or is a simulation, whose times are not of this world. Nothing is known of
  // a tape of other variables than those of the store, and nothing settled since its node began.
  static std::optional<TapeHistory> read(const std::string& node, const vars::Store& store, const Wanted& wanted);

  // Returns by index in the store's directory which variables its node's tape has; all false under the same conditions.
  static std::vector<bool> held(const std::string& node, const vars::Store& store);

  // When the item is known; empty if it is on no track.
  [[nodiscard]] const TimeSpan& span_of(std::size_t item) const noexcept { return items_[item].span; }
  // Adds what was found of an item in this time.
  void take(std::size_t item, const TimeSpan& span, HistoryFindings& to) const;
  // The item's last value before this time.
  [[nodiscard]] std::optional<HistoryValue> last_before(std::size_t item, std::int64_t time_ns) const;
  // Runs become visible when they end: what began before this time has ended.
  [[nodiscard]] std::int64_t settled_ns() const noexcept { return settled_ns_; }

 private:
  // What is known of an item, by time.
  struct Known {
    TimeSpan span;
    std::vector<HistoryValue> values;
    std::vector<HistoryGap> gaps;
  };

  explicit TapeHistory(Wanted wanted) : wanted_(std::move(wanted)), items_(wanted_.items.size()) {}
  void read_track(tape::Follower& follower, std::size_t track, const std::vector<std::uint32_t>& items,
                  const RunView& run);
  void note(const tape::Run& run, const std::vector<std::uint32_t>& items);
  void note_value(std::uint32_t item, std::int64_t node_ns, std::span<const std::uint8_t> whole);
  [[nodiscard]] std::int64_t wall_ns(std::int64_t node_ns) const noexcept {
    return node_ns + wanted_.real_minus_node_ns;
  }

  Wanted wanted_;
  std::vector<Known> items_;
  std::int64_t settled_ns_ = 0;
  std::int64_t longest_ns_ = 0;  // longest run, measured from its release
  std::int64_t newest_ns_ = 0;   // end of a run
};

}  // namespace indurop::tools
