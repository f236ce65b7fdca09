// SPDX-License-Identifier: Apache-2.0
// A scope on a node: waits for a trigger in every tick, keeps what was before, and takes what comes after it. Looks
// only. Of one thread; not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/exit_code.h"
#include "tools/command/failure.h"
#include "tools/scope/channels.h"
#include "tools/scope/sampler.h"

namespace indurop::tools {

enum class ScopeMode {
  Single,  // one picture
  Normal,  // one for each trigger
  Auto     // also without a trigger, if none comes for a while
};

struct ScopeOrder {
  std::vector<std::string> channels;
  std::string trigger;  // empty: at once
  std::uint64_t pre = 100;
  std::uint64_t post = 400;
  ScopeMode mode = ScopeMode::Single;
  bool past = false;             // what is on the tape already counts too,
  std::uint64_t after_tick = 0;  // from behind this tick on
};
inline constexpr std::uint64_t kMostScopeRows = 1'000'000;
inline constexpr std::uint64_t kMostScopeNumbers = 8'000'000;  // rows by lines

// One picture. Row i is tick first_tick + i; lines of all channels one after the other.
struct Capture {
  std::vector<ScopeChannel> channels;
  std::vector<std::vector<double>> lines;  // NaN: not known yet
  std::uint64_t first_tick = 0;
  std::optional<std::size_t> trigger_row;  // none: nothing triggered it
  std::string trigger;
  std::int64_t period_ns = 0;
  std::int64_t first_ns = 0;       // the node's time of the first row
  std::int64_t first_wall_ns = 0;  // the same by CLOCK_REALTIME
  std::uint64_t lost_runs = 0;     // while it was taken
  [[nodiscard]] std::size_t rows() const noexcept { return lines.empty() ? 0 : lines.front().size(); }
};

class Scope {
 public:
  // Errors: the node does not run or keeps no tape; channels or trigger make no sense; more than fits.
  static Result<Scope, Failure> open(const std::string& node, const ScopeOrder& order);

  // Takes what is on the tape. A picture, if one is complete. Call it again at once if there was one, else every few
  // milliseconds: what is not taken in time is overwritten, after about two seconds.
  std::optional<Capture> poll();
  // The node has ended, or another run of it has begun: nothing comes any more.
  [[nodiscard]] bool over() const;
  // The trigger came; the picture does when its last tick has ended.
  [[nodiscard]] bool fired() const noexcept { return fired_.has_value(); }
  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }  // looked at so far
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
  std::uint64_t due_tick_ = 0;          // of auto: a picture without a trigger
  std::uint64_t ticks_ = 0;
  std::uint64_t lost_before_ = 0;
  std::int64_t real_minus_node_ns_ = 0;
  bool live_ = false;  // what was on the tape before is read
};

}  // namespace indurop::tools
