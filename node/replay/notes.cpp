// SPDX-License-Identifier: Apache-2.0
#include "node/replay/notes.h"

#include <algorithm>
#include <filesystem>

#include "core/base/duration.h"

namespace indurop::node {
namespace {

// The condition of another file could be true at other times.
void warn_about_conditions(const Checked& checked, const ReplayedModules& modules, const Console& console) {
  for (const std::uint32_t i : checked.replaced) {
    const config::Module& module = checked.config.modules[i];
    if (modules.all()[i]->runs && module.operation == scheduler::Operation::Sporadic) {
      console.warning(
          "module {} runs when it ran in the recording: the condition of the other file is not evaluated; to see when "
          "it is true, simulate or run it",
          module.name);
    }
  }
}

void warn_about_format(const RecordedRuns& recorded, const Console& console) {
  if (recorded.format() < recorder::kRecordingFormat) {
    console.warning(
        "the recording is of an older release: what snapshot(), valid(), age(), connected channels and "
        "stop_requested() returned to the runs is not in it, so runs that called them may differ although their "
        "modules are the same");
  } else if (recorded.format() > recorder::kRecordingFormat) {
    console.warning(
        "the recording is of a newer release: records that this release does not know are not replayed; replay it with "
        "the release that recorded it");
  }
}

// Runs are repeated at their recorded times: another period or priority has no effect.
void warn_about_schedule(const config::Config& config, const explain::Facts& facts, const Console& console) {
  if (facts.schedule > 1) {
    console.warning(
        "schedule {} took over in tick {}: runs come as recorded, but irp::period() returns what this configuration "
        "says, before that tick and after it",
        facts.schedule, facts.schedule_tick);
  }
  for (const explain::ModuleFact& then : facts.modules) {
    for (const config::Module& now : config.modules) {
      const bool periodic = now.operation == scheduler::Operation::Periodic;
      if (now.name != then.name) {
        continue;
      }
      if (periodic && now.period.count() != then.period_ns) {
        console.warning(
            "module {} has a period of {} in this configuration and had one of {}: its runs come as recorded", now.name,
            base::format_duration(now.period), base::format_duration(base::Nanos(then.period_ns)));
      }
      if (now.operation != scheduler::Operation::NonReal && now.priority != then.priority) {
        console.warning("module {} has priority {} in this configuration and had {}: its runs come as recorded",
                        now.name, now.priority, then.priority);
      }
    }
  }
}

}  // namespace

void print_notes(const Checked& checked, const ReplayedModules& modules, const RecordedRuns& recorded,
                 const explain::Facts& facts, const Console& console) {
  warn_about_conditions(checked, modules, console);
  warn_about_format(recorded, console);
  warn_about_schedule(checked.config, facts, console);
}

}  // namespace indurop::node
