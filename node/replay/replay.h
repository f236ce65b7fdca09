// SPDX-License-Identifier: Apache-2.0
// --replay: repeats the runs of a recording, each with the inputs it had, and compares what they write.

#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "node/modules/processes.h"
#include "node/replay/forced_then.h"
#include "node/replay/output.h"
#include "node/replay/recorded_runs.h"
#include "node/replay/replayed_memory.h"
#include "node/run/checked.h"
#include "node/run/console.h"
#include "node/run/loaded.h"
#include "node/run/phases.h"
#include "node/run/prepared.h"
#include "scheduler/runner.h"
#include "store/tape/replay_input.h"

namespace indurop::node {

inline constexpr std::uint32_t kNoSuchModule = 0xffffffff;

class Replay {
 public:
  // All references are borrowed.
  Replay(const Options& options, Console& console, base::StopSignal& signals, Checked& checked, Prepared& prepared,
         Loaded& loaded);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  // Starts the modules, runs and compares, reports the outcome, ends the modules.
  Ending run();

 private:
  // A clock that is stopped except when a run of the recording sets it.
  class Kernel final : public scheduler::Kernel {
   public:
    explicit Kernel(std::vector<std::atomic<std::int64_t>*> shown) : shown_(std::move(shown)) {}
    rt::MonoTime now() noexcept override { return rt::mono_time(shown_.front()->load(std::memory_order_relaxed)); }
    void sleep_until(rt::MonoTime /*deadline*/) noexcept override {}
    void set(std::int64_t ns) noexcept;

   private:
    std::vector<std::atomic<std::int64_t>*> shown_;
  };
  // The recorded values of one variable for a module.
  struct Known {
    std::uint32_t variable = 0;
    bool read = false;
    bool written = false;
    bool has_value = false;
    bool ever_recorded = false;  // anywhere in the recording
    bool ever_compared = false;
    std::uint64_t recorded_run = 0;  // run (Module::seen) in which it was recorded last
    std::vector<std::uint8_t> cdr;
    std::vector<std::uint8_t> bytes;
    std::uint64_t compared = 0;   // runs whose value was compared because their inputs were the same
    std::uint64_t differing = 0;  // of these: runs that wrote another value
    std::uint64_t first_tick = 0;
    std::string first_place;  // first part of it that differed
    std::string first_was;
    std::string first_is;
  };
  // A value a run wrote, from the recording.
  struct Left {
    std::size_t place = 0;  // in Module::known
    tape::EntryKind kind{};
    std::vector<std::uint8_t> cdr;
    std::vector<std::uint8_t> bytes;
  };
  struct Module {
    bool runs = false;
    std::string why_not;          // why it does not run; empty: it is not in this configuration
    std::string unknown_inputs;   // variables that it reads and that are not recorded; empty: none
    std::uint64_t left_out = 0;   // runs that were not repeated for that reason
    std::uint64_t too_early = 0;  // not repeated because not all of their inputs are recorded before them
    std::uint64_t repeated = 0;
    std::uint64_t seen = 0;  // runs in the recording
    std::vector<Known> known;
    std::vector<Left> left;           // outputs of the run being read
    std::vector<std::int64_t> clock;  // clock readings of that run
    std::vector<std::int64_t> codes;  // returned by functions and channels in that run
    std::vector<std::vector<std::uint8_t>> answers;
    [[nodiscard]] std::vector<tape::ReplayedAnswer> replayed_answers() const;
    std::map<std::uint32_t, std::size_t> place;  // of a variable in `known`
    scheduler::TaskState state;
    std::uint64_t count = 0;
    std::uint64_t next_number = 0;
    ReplayedMemory kept;
    bool restart_due = false;  // it must be restarted before it runs again
    bool restores = false;     // its keyframe is put back before this run
    bool died = false;         // its process ended
    bool disturbed = false;    // its inputs were changed while it ran
    std::uint64_t disturbed_runs = 0;
    bool faulted_alike = false;
    bool apart = false;  // it faulted only in the replay or only in the recording
  };

  [[nodiscard]] std::uint32_t configured(std::uint32_t recorded) const noexcept;
  bool choose_modules(const RecordedRuns& recorded);
  void warn_about_conditions() const;
  void warn_about_format(const RecordedRuns& recorded) const;
  void warn_about_schedule(const explain::Facts& facts) const;
  void look_ahead();
  void find_keyframes_to_begin_at();
  [[nodiscard]] bool is_wanted(std::uint64_t tick) const noexcept { return tick >= options_.replay.from_tick; }
  bool learn_early(const RecordedValue& value, Module& module, bool after_a_gap) const;
  void leave_out_if_unknown(Module& module, const std::string& name);
  bool begin(const RecordedRuns& recorded);
  bool take(const RecordedValue& value);
  bool start_modules();
  bool replay(RecordedRuns& recorded);
  bool replay_run(const recorder::RunWords& run);
  bool can_repeat(Module& module, const recorder::RunWords& run);
  void doubt(Module& module, std::uint64_t tick);
  bool repeat(Module& module, std::uint32_t index, const recorder::RunWords& run);
  void restore(Module& module);
  bool restart(Module& module, std::uint32_t index);
  bool restart_process(std::uint32_t index);
  bool call(std::uint32_t index, const char* phase, void (*function)());
  void run_process(Module& module, std::uint32_t index, const tape::RunTail& tail);
  [[nodiscard]] static bool knows_inputs(const Module& module) noexcept;
  static void forget(Module& module) noexcept;
  void give_inputs(Module& module);
  void take_recorded_outputs(Module& module);
  void compare(Module& module, std::uint32_t index, const recorder::RunWords& run);
  void differs(Module& module, std::uint32_t index, Known& known, std::uint64_t tick,
               const std::vector<std::uint8_t>& now);
  void close_output();
  void write_output(std::uint32_t index, const std::vector<std::uint8_t>& cdr, std::int64_t end_ns);
  Ending conclude();
  bool report_left_out();
  void report_differences();
  scheduler::Hooks hooks();
  scheduler::Hooks run_hooks();
  [[nodiscard]] const schema::Variable& variable(std::uint32_t index) const;

  const Options& options_;
  Console& console_;
  base::StopSignal& signals_;
  Checked& checked_;
  Prepared& prepared_;
  const std::vector<ModuleLibrary>& libraries_;
  scheduler::RunBlock& run_;
  Kernel kernel_;
  scheduler::CoreTrace trace_;
  scheduler::Runner runner_;
  Phases phases_;
  Processes processes_;
  std::optional<tape::ReplayInputWriter> replay_input_;  // for process modules, if there are any
  std::vector<std::unique_ptr<Module>> modules_;         // as in the configuration
  std::vector<std::uint32_t> of_recording_;              // index of each module of the recording; kNoSuchModule: none
  std::int64_t real_minus_node_ns_ = 0;
  std::optional<ReplayOutput> output_;
  bool output_failed_ = false;
  bool damaged_ = false;  // parts of the recording could not be read
  bool closed_ = false;   // the recording is complete
  std::uint64_t ticks_ = 0;
  std::uint64_t runs_ = 0;
  std::atomic<std::uint64_t> returned_{0};  // the same, for the check whether one hangs
  std::uint64_t runs_not_here_ = 0;         // of modules that are not in the configuration
  std::uint64_t values_ = 0;
  std::uint64_t differences_ = 0;
  ForcedThen forced_then_;
  std::map<std::string, std::uint64_t> forced_;  // values that were not compared, by variable
  std::uint64_t unclear_ = 0;                    // differences of runs whose inputs changed while they ran
};

}  // namespace indurop::node
