// SPDX-License-Identifier: Apache-2.0
// A module of a replay: the values the recording has for it, the run of it that is read, and what became of its runs.

#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/schema/elf.h"
#include "history/recorder/run_words.h"
#include "node/replay/distance.h"
#include "node/replay/recorded_runs.h"
#include "node/replay/replayed_memory.h"
#include "scheduler/runner.h"
#include "store/tape/replay_input.h"
#include "store/vars/store.h"

namespace indurop::node {

// The variable of an index in the store's directory.
const schema::Variable& variable_at(const vars::Store& store, std::uint32_t index);
// A recorded value as the store declares its variable. If its type has changed (`former`: how the recording declares
// it; else null), these are the parts that fit, and the others as they are in the store.
std::vector<std::uint8_t> as_declared_now(const vars::Store& store, std::uint32_t index, const schema::Variable* former,
                                          const std::vector<std::uint8_t>& bytes);

// The recorded values of one variable for a module.
struct KnownValue {
  std::uint32_t variable = 0;
  const schema::Variable* former = nullptr;  // declaration that these values have; null: that of the store
  bool read = false;
  bool written = false;
  bool always_read = false;  // by the configuration, whatever the module's code does
  bool always_written = false;
  bool only_viewed = false;  // the module has another file here, which may write other values for tools (@view)
  bool has_value = false;
  bool ever_recorded = false;  // anywhere in the recording
  bool ever_compared = false;
  bool foreign = true;             // no repeated run, but another writer or a run before wrote the value last
  std::uint64_t recorded_run = 0;  // run (ReplayedModule::seen) in which it was recorded last
  std::vector<std::uint8_t> cdr;
  std::vector<std::uint8_t> bytes;
  std::uint64_t compared = 0;   // runs whose value was compared because their inputs were the same
  std::uint64_t differing = 0;  // of these: runs that wrote another value
  std::uint64_t first_tick = 0;
  std::string first_place;  // first part of it that differed
  std::string first_was;
  std::string first_is;
  std::uint64_t unclear = 0;  // runs that wrote another value, perhaps because their inputs changed while they ran
  Distance farthest;          // of all values that differ, unclear ones too
};

// A value a run wrote, from the recording.
struct RecordedOutput {
  std::size_t place = 0;  // in ReplayedModule::known
  tape::EntryKind kind{};
  std::vector<std::uint8_t> cdr;
  std::vector<std::uint8_t> bytes;
};

// Whether what a module keeps is what the recorded one kept.
enum class Knowledge : std::uint8_t { None, Doubtful, Certain };

struct ReplayedModule {
  std::uint32_t index = 0;  // in the configuration
  std::string name;
  bool runs = false;
  std::string why_not;         // why it does not run; empty: it does
  std::string unknown_inputs;  // variables that it reads and that are not recorded; empty: none
  scheduler::TaskState state;
  ReplayedMemory kept;
  Knowledge knowledge = Knowledge::None;  // after the run that was repeated last
  std::vector<KnownValue> known;
  std::map<std::uint32_t, std::size_t> place;  // of a variable in `known`
  std::set<std::string> not_written;           // variables that the recorded module wrote and this file does not

  // The run that is read.
  std::vector<RecordedOutput> outputs;
  std::vector<std::int64_t> clock;  // its clock readings
  std::vector<std::int64_t> codes;  // returned by functions and channels
  std::vector<std::vector<std::uint8_t>> answers;
  bool restart_due = false;  // it must be restarted before it runs again
  bool was_stopped = false;  // its stop() was called for that
  bool restores = false;     // its keyframe is put back before this run
  bool disturbed = false;    // its inputs were changed while it ran
  std::int64_t busy_ns = 0;  // processor time of the repeated run; of a process, with that of waiting for it

  // Numbers of runs.
  std::uint64_t seen = 0;       // in the recording
  std::uint64_t left_out = 0;   // not repeated because of unknown inputs
  std::uint64_t too_early = 0;  // not repeated because not all of their inputs are recorded before them
  std::uint64_t lacking = 0;    // not repeated because their version declares variables in another way
  std::uint64_t repeated = 0;
  std::uint64_t disturbed_runs = 0;
  std::uint64_t next_number = 0;  // of the run that follows the last one that was read

  bool died = false;  // its process ended
  bool faulted_alike = false;
  bool apart = false;  // it faulted only in the replay or only in the recording
  std::uint64_t apart_tick = 0;

  // For a module that was exchanged in the recording.
  std::map<std::uint64_t, schema::Access> version_access;  // what any of its versions reads or writes
  bool lacks_version = false;                              // its version of this run cannot repeat it
  bool begins_again = false;                               // that version begins with initial values
  bool continues = false;                                  // what its process keeps is put back, if it can be

  // For a module that goes on with what it wrote itself.
  bool keeps_own = false;
  bool doubtful = false;  // a run was disturbed since it began with what the recorded module kept

  [[nodiscard]] bool is_process() const noexcept { return state.task.type == scheduler::ModuleType::Process; }
  [[nodiscard]] bool has_faulted() const noexcept;
  [[nodiscard]] std::vector<tape::ReplayedAnswer> replayed_answers() const;
  // Returns whether a value of each variable that it reads is known.
  [[nodiscard]] bool knows_inputs() const noexcept;
  // Keeps only the values of the run that was read last: the others may have changed since.
  void forget_older_values() noexcept;
  // The version that runs now reads and writes this, and what the configuration says.
  void use(const std::map<std::uint64_t, schema::Access>& access, const vars::Store& store);
  // Writes the known inputs of the next run to the store.
  void write_inputs(vars::Store& store) const;
  // The next run begins with all recorded values, also of what it wrote itself.
  void begin_with_recorded() noexcept;
  // Notes what is known of what the next run begins with. `restarted`: the module was started again before it.
  void note_knowledge(ReplayedMemory::Next next, bool restarted) noexcept;
  // Notes whether the run that was repeated last was disturbed, and what that means for the following ones.
  void note_disturbance() noexcept;
  // Writes what a run that was not repeated had written: the next run begins with it.
  void write_outputs(vars::Store& store) const;
  // Makes the recorded outputs of the run that was read the known values.
  void take_outputs();
};

}  // namespace indurop::node
