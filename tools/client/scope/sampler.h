// SPDX-License-Identifier: Apache-2.0
// A node's tape as one row of numbers for each tick: the values at the end of the tick. Only reads; the node is not
// affected. For one thread at a time.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "store/tape/follower.h"
#include "store/vars/store.h"
#include "tools/client/node/run_view.h"
#include "tools/client/scope/channels.h"

namespace indurop::tools {

class TickSampler {
 public:
  // `store`: that of the follower's node, of the same layout; only needed during this call. Errors: a variable that is
  // on no tape.
  static Result<TickSampler, base::Problem> create(tape::Follower follower, const RunView& run,
                                                   const vars::Store& store, const std::vector<ScopeInput>& inputs);

  // Reads what is on the tape; rows of ticks that have ended are available afterwards.
  void take();
  // Returns the next tick's row, in the order of the inputs; empty: it is not available yet. Valid until the next call.
  std::span<const double> next(std::uint64_t& tick);

  // Number of runs that were overwritten before they were read: values in between are unknown.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  [[nodiscard]] std::int64_t time_of(std::uint64_t tick) const noexcept {
    return epoch_ns_ + static_cast<std::int64_t>(tick) * period_ns_;
  }
  [[nodiscard]] std::int64_t period_ns() const noexcept { return period_ns_; }

 private:
  // A number that changed, and when.
  struct Event {
    std::int64_t time_ns = 0;
    std::uint32_t input = 0;
    double value = 0;
  };
  TickSampler(tape::Follower follower, std::vector<ScopeInput> inputs)
      : follower_(std::move(follower)), inputs_(std::move(inputs)) {}
  Result<void, base::Problem> choose_tracks(const RunView& run, const vars::Store& store);
  void note(const tape::Run& run, const std::vector<std::vector<std::uint32_t>>& wanted);

  struct Track {
    std::size_t track = 0;
    std::vector<std::vector<std::uint32_t>> wanted;  // by variable: its inputs
  };

  tape::Follower follower_;
  std::vector<ScopeInput> inputs_;
  std::vector<Track> tracks_;
  tape::Run run_;
  std::vector<Event> events_;  // from used_ on, sorted by time
  std::size_t used_ = 0;
  std::vector<double> values_;
  std::int64_t epoch_ns_ = 0;
  std::int64_t period_ns_ = 1;
  std::int64_t newest_ns_ = 0;   // end of a run
  std::int64_t oldest_ns_ = 0;   // begin of a run
  std::int64_t longest_ns_ = 0;  // longest run, measured from its release
  std::uint64_t next_tick_ = 0;
  bool begun_ = false;
  std::uint64_t lost_ = 0;
};

}  // namespace indurop::tools
