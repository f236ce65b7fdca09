// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/verbs/reload_schedule.h"

#include <fmt/format.h>

#include <utility>

#include "tools/cli/command/config_file.h"
#include "tools/cli/values/forcing.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/node/schedule_reload.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using scheduler::CommandResult;

void print_fates(Context& context, const operate::ScheduleReport& report) {
  for (const operate::ScheduleReport::Module& module : report.modules) {
    context.out.line(fmt::format("  {:<11} {}{}{}", printable(module.fate), printable(module.name),
                                 module.text.empty() ? "" : ": ", printable(module.text)));
  }
  for (const std::string& why : report.restarts) {
    context.out.line(fmt::format("  {:<11} {}", "restart", printable(why)));
  }
}

}  // namespace

int reload_schedule(Context& context, const ScheduleOptions& options) {
  const auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  operate::ScheduleRequest request;
  request.back = options.config.empty();
  request.dry_run = options.dry_run;
  if (!request.back) {
    auto file = absolute_name(options.config);
    if (!file) {
      return report(context.out, file.error());
    }
    request.config = std::move(file).value();
  }
  const auto done = change_schedule(*node, request, options.timeout_ns, who_orders(context));
  if (!done) {
    return report(context.out, done.error());
  }
  const bool changed = done->result == CommandResult::Done && !options.dry_run;
  if (changed) {
    note_for_audit(context, *node, "reload --config",
                   fmt::format("schedule {}: {}", done->report.schedule, request.back ? "before" : request.config));
  }
  for (const std::string& message : done->report.messages) {
    context.out.message_line(printable(message));
  }
  if (context.format == Format::Json) {
    context.out.line(operate::json_of(done->report).dump(2));
  } else {
    print_fates(context, done->report);
  }
  const std::string text = "schedule: " + printable(done->report.text);
  if (done->result != CommandResult::Done) {
    context.out.error(text);
    return done->result == CommandResult::Refused ? kCheckFailed : kFailed;
  }
  context.out.note(text);
  if (changed && context.format != Format::Json) {
    context.out.line(fmt::format("  schedule {} counts since tick {}", done->report.schedule, done->report.tick));
  }
  return kOk;
}

}  // namespace indurop::tools
