// SPDX-License-Identifier: Apache-2.0
// Gives a running node of this machine another schedule.

#pragma once

#include <cstdint>
#include <string>

#include "store/operate/schedule_request.h"
#include "tools/client/node/module_command.h"

namespace indurop::tools {

struct Rescheduled {
  scheduler::CommandResult result = scheduler::CommandResult::None;
  operate::ScheduleReport report;
};

// Commands it and waits until the node has answered, at most `timeout_ns`; user and reason go to the node's journal.
Result<Rescheduled, Failure> change_schedule(const std::string& node, const operate::ScheduleRequest& request,
                                             std::int64_t timeout_ns, const operate::Who& who);

}  // namespace indurop::tools
