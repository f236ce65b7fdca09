// SPDX-License-Identifier: Apache-2.0
// A scope on a node: evaluates a trigger in every tick and captures the values before and after it. Only reads. Used by
// one thread; not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/exit_code.h"
#include "tools/client/failure.h"
#include "tools/client/scope/channels.h"
#include "tools/client/scope/sampler.h"

namespace indurop::tools {

enum class ScopeMode {
  Single,  // one capture
  Normal,  // one capture for each trigger
  Auto     // also without a trigger, if there is none for a while
};

struct ScopeOrder {
  std::vector<std::string> channels;
  std::string trigger;  // empty: at once
  std::uint64_t pre = 100;
  std::uint64_t post = 400;
  ScopeMode mode = ScopeMode::Single;
  bool past = false;             // also evaluates what is on the tape already,
  std::uint64_t after_tick = 0;  // after this tick
};
inline constexpr std::uint64_t kMostScopeRows = 1'000'000;
inline constexpr std::uint64_t kMostScopeNumbers = 8'000'000;  // rows times lines

// One capture. Row i is tick first_tick + i; `lines` has the lines of all channels one after the other.
struct Capture {
  std::vector<ScopeChannel> channels;
  std::vector<std::vector<double>> lines;  // NaN: not known yet
  std::uint64_t first_tick = 0;
  std::optional<std::size_t> trigger_row;  // none: not triggered
  std::string trigger;
  std::int64_t period_ns = 0;
  std::int64_t first_ns = 0;       // time of the first row on the node's clock
  std::int64_t first_wall_ns = 0;  // the same by CLOCK_REALTIME
  std::uint64_t lost_runs = 0;     // during the capture
  [[nodiscard]] std::size_t rows() const noexcept { return lines.empty() ? 0 : lines.front().size(); }
};

class Scope {
 public:
  // Errors: the node does not run or has no tape; channels or trigger are invalid; more than fits.
  static Result<Scope, Failure> open(const std::string& node, const ScopeOrder& order);

  // Reads the tape. Returns a capture if one is complete; then call it again at once, else every few milliseconds: data
  // not read in time is overwritten after about two seconds.
  std::optional<Capture> poll();
  // Returns true if the node has ended, or was started again: no more data follows.
  [[nodiscard]] bool over() const;
  // Returns true if the trigger has fired; the capture is returned when its last tick has ended.
  [[nodiscard]] bool fired() const noexcept { return fired_.has_value(); }
  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }  // evaluated so far
  [[nodiscard]] const std::string& node() const noexcept { return node_; }

 private:
  Scope(std::string node, const ScopeOrder& order, ScopePlan plan, RunView run, TickSampler sampler)
      : node_(std::move(node)),
        order_(order),
        plan_(std::move(plan)),
        run_(std::move(run)),
        sampler_(std::move(sampler)) {}
  bool add(std::uint64_t tick, std::span<const double> inputs);
  Capture picture();

  std::string node_;
  ScopeOrder order_;
  ScopePlan plan_;
  RunView run_;
  TickSampler sampler_;
  std::deque<std::vector<double>> rows_;
  std::uint64_t newest_tick_ = 0;
  std::optional<std::uint64_t> fired_;  // its tick
  std::uint64_t due_tick_ = 0;          // for Auto: tick of a capture without a trigger
  std::uint64_t ticks_ = 0;
  std::uint64_t lost_before_ = 0;
  std::int64_t real_minus_node_ns_ = 0;
  bool live_ = false;  // the older part of the tape was read
};

}  // namespace indurop::tools
