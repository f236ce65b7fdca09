// SPDX-License-Identifier: Apache-2.0
// Messages of a replay before it begins: which settings of this configuration it ignores, and what the recording lacks.

#include <algorithm>
#include <filesystem>

#include "core/base/duration.h"
#include "node/replay/replay.h"

namespace indurop::node {

// The condition of another file could be true at other times.
void Replay::warn_about_conditions() const {
  const auto& with = options_.replay.with;
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    const config::Module& module = checked_.config.modules[i];
    const bool other = std::any_of(with.begin(), with.end(), [&](const std::string& file) {
      return module.file == std::filesystem::absolute(file);
    });
    if (other && modules_[i]->runs && module.operation == scheduler::Operation::Sporadic) {
      console_.warning(
          "module {} runs when it ran in the recording: the condition of the other file is not evaluated; to see when "
          "it is true, simulate or run it",
          module.name);
    }
  }
}

void Replay::warn_about_format(const RecordedRuns& recorded) const {
  if (recorded.format() < recorder::kRecordingFormat) {
    console_.warning(
        "the recording is of an older release: what snapshot(), valid(), age(), connected channels and "
        "stop_requested() returned to the runs is not in it, so runs that called them may differ although their "
        "modules are the same");
  } else if (recorded.format() > recorder::kRecordingFormat) {
    console_.warning(
        "the recording is of a newer release: records that this release does not know are not replayed; replay it with "
        "the release that recorded it");
  }
}

// Runs are repeated at their recorded times: another period or priority has no effect.
void Replay::warn_about_schedule(const explain::Facts& facts) const {
  for (const explain::ModuleFact& then : facts.modules) {
    for (const config::Module& now : checked_.config.modules) {
      const bool periodic = now.operation == scheduler::Operation::Periodic;
      if (now.name != then.name) {
        continue;
      }
      if (periodic && now.period.count() != then.period_ns) {
        console_.warning(
            "module {} has a period of {} in this configuration and had one of {}: its runs come as recorded", now.name,
            base::format_duration(now.period), base::format_duration(base::Nanos(then.period_ns)));
      }
      if (now.operation != scheduler::Operation::NonReal && now.priority != then.priority) {
        console_.warning("module {} has priority {} in this configuration and had {}: its runs come as recorded",
                         now.name, now.priority, then.priority);
      }
    }
  }
}

}  // namespace indurop::node
