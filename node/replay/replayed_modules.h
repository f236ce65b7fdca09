// SPDX-License-Identifier: Apache-2.0
// The modules of a replay: which of them run again, and the recorded values for them. A recording may contain only
// chosen variables, begin in the middle, or miss runs.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "node/replay/other_declarations.h"
#include "node/replay/recorded_runs.h"
#include "node/replay/replayed_module.h"
#include "node/run/checked.h"
#include "node/run/console.h"
#include "node/run/loaded.h"
#include "node/run/options.h"
#include "node/run/prepared.h"

namespace indurop::node {

class ReplayedModules {
 public:
  // All references are borrowed.
  ReplayedModules(const Options& options, const Console& console, const Checked& checked, const Prepared& prepared,
                  const Loaded& loaded);

  // Finds out which variables of the only module that runs (`alone`: its index) its node does not have, or has with
  // another type.
  void compare_with_node(const std::string& node, std::size_t alone);
  [[nodiscard]] const OtherDeclarations& others() const noexcept { return others_; }
  // Determines which modules run, and reports why others do not.
  void choose(const RecordedRuns& recorded);
  // Finds their variables, and the keyframes at which they begin.
  void find_begin();
  // Finds the values that were present from the first run of the recording on, and leaves out modules whose inputs are
  // recorded nowhere. Returns false, after an error, if no module runs.
  bool look_ahead();
  // Adds a value to the known ones of its module. A first value goes to the store. Returns false, after an error, if it
  // is damaged.
  bool take(const RecordedValue& value);

  // The log time at which the replay begins, after the modules were started: not before their keyframes; 0: at the
  // first item of the recording.
  [[nodiscard]] std::uint64_t begin_ns() const noexcept { return begin_ns_; }
  // Makes the values from before that time the known ones, and writes them to the store.
  void begin_late();

  // Writes to the store what a module had written before its first run in the recording: a run that does not write it
  // again leaves it there. What other modules write, too, is left alone.
  void write_first_outputs(const ReplayedModule& module);

  // The module that corresponds to a module of the recording; null: it is not in this configuration.
  [[nodiscard]] ReplayedModule* of_recording(std::uint32_t recorded) const noexcept;
  // Returns whether the recording has a module of this index; it also has values that no module reads or writes.
  [[nodiscard]] bool is_recorded(std::uint32_t recorded) const noexcept { return recorded < of_recording_.size(); }
  [[nodiscard]] const std::vector<std::unique_ptr<ReplayedModule>>& all() const noexcept { return modules_; }

 private:
  // How the recording declares the variable of an index in the store's directory.
  [[nodiscard]] const schema::Variable& recorded_declaration(std::uint32_t index) const;
  void match(const RecordedRuns& recorded);
  void find_variables();
  void learn_early_values();
  bool learn_early(const RecordedValue& value, ReplayedModule& module, bool after_a_gap) const;
  void leave_out_if_unknown(ReplayedModule& module) const;
  void find_keyframes_to_begin_at();
  struct Begin {
    std::uint64_t run = 0;      // number of the run that begins with a keyframe
    std::uint64_t time_ns = 0;  // log time of the keyframe
  };
  [[nodiscard]] std::vector<std::optional<Begin>> keyframes_between(RecordedRuns& recorded, std::uint64_t begin_ns,
                                                                    std::uint64_t end_ns) const;
  void find_earlier_values(const RecordedRuns& recorded);

  const Options& options_;
  const Console& console_;
  const Checked& checked_;
  vars::Store& store_;
  const std::vector<ModuleLibrary>& libraries_;
  std::vector<std::unique_ptr<ReplayedModule>> modules_;  // as in the configuration
  std::vector<ReplayedModule*> of_recording_;             // null: not in the configuration
  OtherDeclarations others_;
  std::uint64_t begin_ns_ = 0;
  std::vector<RecordedRuns::EarlierValue> earlier_;  // the last ones before begin_ns_
};

}  // namespace indurop::node
