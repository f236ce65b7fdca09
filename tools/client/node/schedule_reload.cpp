// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/schedule_reload.h"

#include <fmt/format.h>

#include <utility>

#include "tools/client/node/module_reload.h"
#include "tools/client/text/units.h"

namespace indurop::tools {

using scheduler::CommandResult;
using scheduler::ModuleCommand;

Result<Rescheduled, Failure> change_schedule(const std::string& node, const operate::ScheduleRequest& request,
                                             std::int64_t timeout_ns, const operate::Who& who) {
  const auto lock = lock_when_free(node, timeout_ns);
  if (!lock) {
    return lock.error();
  }
  if (!operate::write_schedule_request(node, request)) {
    return Failure{kFailed, fmt::format("the folder of node '{}' cannot be written by this user", node)};
  }
  const auto run = RunView::open(node);
  const std::string first = run && run->module_count() > 0 ? fixed_text(run->module(0).name) : std::string();
  auto answer = await_answer(node, ModuleCommand::Schedule, first, timeout_ns);
  if (!answer) {
    return answer.error();
  }
  if (answer->result == CommandResult::Ending) {
    return Failure{kUnreachable, "the schedule has not changed: the node itself ends"};
  }
  auto report = operate::read_schedule_report(node);
  if (!report) {
    return Failure{kFailed, fmt::format("node '{}' left no report of its schedule", node)};
  }
  if (answer->result == CommandResult::Done && !request.dry_run) {
    note_command(node, answer->run, ModuleCommand::Schedule, "schedule",
                 fmt::format("{}: {}", report->schedule, request.back ? "the one before" : request.config), who);
  }
  return Rescheduled{answer->result, *std::move(report)};
}

}  // namespace indurop::tools
