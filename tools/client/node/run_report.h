// SPDX-License-Identifier: Apache-2.0
// The status of a node as a whole, from its run block, for `status` and `nodes`.

#pragma once

#include <string>
#include <vector>

#include "tools/client/node/run_view.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

inline constexpr const char* kHung = "hung";

struct NodeReport {
  std::string node;
  bool alive = false;
  std::string state;  // "running", "hung" if its process does not continue, "killed" after a kill
  std::int32_t pid = 0;
  std::string config_file;
  std::string deployment;  // empty: none
  std::string stop_reason;
  std::int64_t basic_period_ns = 0;
  std::int64_t macro_period_ns = 0;
  std::uint64_t ticks = 0;
  std::uint64_t lost_ticks = 0;
  std::uint64_t schedule = 0;       // number; 1: the one that the node started with
  std::uint64_t schedule_tick = 0;  // its first
  std::string schedule_file;
  std::int64_t uptime_ns = 0;  // since tick 0; 0 if unknown or not running
  std::uint32_t modules = 0;
  std::uint64_t overruns = 0;  // sum over all modules
  std::uint64_t faults = 0;
  scheduler::Obtained rt{};
  std::vector<std::string> same_core;  // other real-time nodes of this host that run their tick on the same core
  scheduler::Summary lateness;
  std::int64_t pulse_after_ns = 0;   // of devices with a clock that ticks follow, after the frames of a tick
  std::int64_t pulse_wanted_ns = 0;  // 0: there are none
  std::string owner;                 // user who owns the store; empty: of another machine
  bool foreign = false;              // the owner is another user
  [[nodiscard]] bool hung() const { return state == kHung; }
};

// Sets the owner from the files in shared memory under the report's name.
void set_owner(NodeReport& report);

NodeReport report_of(const std::string& node, const RunView& run);
// Returns "FIFO 90 on core 1, memory locked" or "no FIFO, ...".
std::string rt_text(const scheduler::Obtained& rt);
JsonValue json_of(const NodeReport& report);

}  // namespace indurop::tools
