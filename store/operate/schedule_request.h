// SPDX-License-Identifier: Apache-2.0
// Another schedule for a running node: what is requested, and what the node reports. Two files in the node's folder;
// the command itself goes through the run block (ModuleCommand::Schedule). Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json.h"

namespace indurop::operate {

struct ScheduleRequest {
  std::string config;    // absolute path of the configuration
  bool back = false;     // return to the schedule before; `config` has no meaning
  bool dry_run = false;  // check, compare and report only
};

struct ScheduleReport {
  // What becomes of a module.
  struct Module {
    std::string name;
    std::string fate;  // "kept", "rescheduled", "added", "ended"
    std::string text;  // "period 2 ms -> 4 ms"; empty: nothing more to say
  };
  std::string text;                   // one sentence: what was done, or why not
  std::vector<std::string> messages;  // of the check: "file:line:col: error: ..."
  std::vector<Module> modules;
  std::vector<std::string> restarts;  // why only a restart of the node leads there; empty: it does not need one
  std::uint64_t schedule = 0;         // number of the schedule that counts
  std::uint64_t tick = 0;             // its first
};

Status write_schedule_request(const std::string& node, const ScheduleRequest& request);
// Called by the node: returns the request and removes it.
std::optional<ScheduleRequest> take_schedule_request(const std::string& node);
Status write_schedule_report(const std::string& node, const ScheduleReport& report);
std::optional<ScheduleReport> read_schedule_report(const std::string& node);

base::Json json_of(const ScheduleReport& report);
base::Json json_of(const std::vector<ScheduleReport::Module>& modules);
std::vector<ScheduleReport::Module> fates_of(const base::Json& json);

}  // namespace indurop::operate
