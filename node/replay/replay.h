// SPDX-License-Identifier: Apache-2.0
// --replay: repeats the runs of a recording, each with the inputs it had, and compares what they write.

#pragma once

#include <optional>

#include "node/replay/alone.h"
#include "node/replay/comparison.h"
#include "node/replay/outcome.h"
#include "node/replay/recorded_runs.h"
#include "node/replay/repeater.h"
#include "node/replay/replayed_modules.h"
#include "node/replay/replayed_versions.h"

namespace indurop::node {

class Replay {
 public:
  // All references are borrowed.
  Replay(const Options& options, Console& console, base::StopSignal& signals, const Checked& checked,
         const Prepared& prepared, Loaded& loaded);

  // Starts the modules, runs and compares, reports the outcome, ends the modules.
  Ending run();

 private:
  bool begin(const RecordedRuns& recorded);
  bool start(const recorder::RunWords* run);
  bool replay(RecordedRuns& recorded);
  void stop_for_debugger(const recorder::RunWords& next);
  [[nodiscard]] bool is_past_the_end(const recorder::RunWords& run) noexcept;
  void take(const RecordedClock& clock);
  void take(const RecordedAnswer& answer);
  void take(const RecordedKeyframe& keyframe);
  void end_at_exchange(ReplayedModule& module, const recorder::RunWords& run);
  bool replay_run(const recorder::RunWords& run);
  bool can_repeat(ReplayedModule& module, const recorder::RunWords& run, bool is_restarted);
  void note_doubt(ReplayedModule& module, std::uint64_t tick);
  Ending conclude();

  const Options& options_;
  Console& console_;
  base::StopSignal& signals_;
  const Checked& checked_;
  vars::Store& store_;
  ReplayedModules modules_;
  ReplayedVersions versions_;
  Repeater repeater_;
  Comparison comparison_;
  Repeated repeated_;
  bool stopped_ = false;        // at the tick where it was to stop
  std::int64_t end_ns_ = 0;     // release of the last tick that is wanted; 0: not known yet
  std::optional<Alone> alone_;  // only this module is repeated
  bool started_ = false;
};

}  // namespace indurop::node
