// SPDX-License-Identifier: Apache-2.0
// Exchanging several modules of a node at one tick: what its agent requests for a deployment, and what the node
// reports. Two files in the node's folder; the command itself goes through the run block (ModuleCommand::Exchange). Not
// real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "store/operate/reload.h"

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
  std::int32_t node_pid = 0;          // of the node that reports
  std::string problem;                // why nothing was exchanged, or the previous versions run again
  std::string refused;                // name of a module whose new version cannot run
  bool needs_restart = false;         // the node can change to it, but only by a restart
  std::vector<ReloadReport> modules;  // in the order of the request
};

Status write_set_request(const std::string& node, const SetRequest& request);
// Called by the node: returns the request and removes it.
std::optional<SetRequest> take_set_request(const std::string& node);
Status write_set_report(const std::string& node, const SetReport& report);
std::optional<SetReport> read_set_report(const std::string& node);

}  // namespace indurop::operate
