// SPDX-License-Identifier: Apache-2.0
// Exchanging several modules of a node at one tick, and its schedule with them: what its agent requests for a
// deployment, and what the node reports. Two files in the node's folder; the command itself goes through the run block
// (ModuleCommand::Exchange). Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "store/operate/reload.h"
#include "store/operate/schedule_request.h"

namespace indurop::operate {

struct SetRequest {
  enum class Act {
    Compare,   // load the new versions, report what would be carried, and discard them
    Prepare,   // load and start them next to the running ones
    Exchange,  // exchange them at `tick`
    Decide,    // `deployment` is what runs from now on: the one that was prepared, or the one before
  };
  struct Module {
    std::string name;
    std::string file;  // of its new version
  };
  Act act = Act::Compare;
  std::string deployment;       // id; Prepare: what runs after the exchange
  std::vector<Module> modules;  // Compare and Prepare
  std::uint64_t tick = 0;       // Exchange: of the first runs of the new versions, or the first ones after it
  std::string config{};         // Compare and Prepare: of the schedule that follows; empty: the schedule stays
};

struct SetReport {
  enum class State {
    None,       // there are no modules to be exchanged
    Preparing,  // new versions are loaded and started next to the running ones
    Compared,   // they were loaded, compared and discarded
    Ready,      // they wait for the tick
    Waiting,    // the tick is known
    Exchanged,  // they run; the previous versions are ready to
    Leaving,    // it is decided which of both run, and not yet done
    Undone,     // the previous versions run; `problem` says why
    Stuck,      // some of both run: the node has to be restarted
  };
  State state = State::None;
  std::int32_t node_pid = 0;                     // of the node that reports
  std::string problem;                           // why nothing was exchanged, or the previous versions run again
  std::string refused;                           // name of a module whose new version cannot run
  bool needs_restart = false;                    // the node can change to it, but only by a restart
  std::vector<ReloadReport> modules;             // in the order of the request
  std::vector<ScheduleReport::Module> schedule;  // what another schedule makes of each module; empty: it stays
  std::uint64_t schedule_tick = 0;               // its first; 0: it has not taken over
  // Ready: the exchange may begin in the ticks whose number leaves `grid_begin` when divided by `grid_ticks`.
  std::uint64_t grid_ticks = 1;
  std::uint64_t grid_begin = 0;
};

Status write_set_request(const std::string& node, const SetRequest& request);
// Called by the node: returns the request and removes it.
std::optional<SetRequest> take_set_request(const std::string& node);
Status write_set_report(const std::string& node, const SetReport& report);
std::optional<SetReport> read_set_report(const std::string& node);

}  // namespace indurop::operate
