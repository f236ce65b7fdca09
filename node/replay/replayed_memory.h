// SPDX-License-Identifier: Apache-2.0
// Whether a module of a replay keeps inside what it kept in the recording: from its first run on, after a restart, and
// from each keyframe on. Between, as after missing runs, only a keyframe makes it so again.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "history/recorder/run_words.h"
#include "node/modules/module_memory.h"

namespace indurop::node {

class ReplayedMemory {
 public:
  // `memory`: of the module as it is loaded now; borrowed. `recorded`: the recording has keyframes of it.
  void expect(const ModuleMemory& memory, bool recorded) noexcept;
  // The same for a process, which keeps it in its own memory: it is put back by Repeater.
  void expect_process(bool declares, bool recorded) noexcept;
  // Another process of the module runs. `empty`: it declares that it keeps nothing.
  void know_process(bool declares, bool empty) noexcept {
    process_declares_ = declares;
    empty_process_ = empty;
  }
  // No run before the run `first` is repeated: a keyframe begins there. Does nothing if this keyframe is of no use.
  void begin_at(std::uint64_t first) noexcept { first_ = has_keyframes() ? first : 0; }

  // The keyframe of a run that follows.
  void take(const recorder::KeyframeRecord& keyframe, const std::string& form);

  enum class Next {
    Run,      // it keeps what it kept
    Restore,  // it will, after restore()
    Wait,     // this run cannot be repeated; a keyframe may follow
    Doubt,    // it may keep something else, and no keyframe can help
  };
  // Called for each run, in order. `restarted`: its module was started again before it. `possible`: all that it reads
  // is known; else it is not repeated.
  Next next(std::uint64_t run, bool restarted, bool possible) noexcept;
  // The next keyframe is put back, although no run is missing. Returns false if there is none to come.
  bool renew() noexcept { return renews_ = has_keyframes(); }
  // The module may keep something else from now on: another version of it follows, and not all it keeps is known.
  void doubt() noexcept { ++missing_; }
  // Returns true if the module declares that it keeps nothing.
  [[nodiscard]] bool is_empty() const noexcept { return memory_ != nullptr ? memory_->is_empty() : empty_process_; }
  // Returns true if the module declares all that it keeps.
  [[nodiscard]] bool is_declared() const noexcept;
  // Puts the keyframe of this run back in a thread module. Returns the names of what was not possible with.
  [[nodiscard]] std::vector<std::string> restore() const;
  // What the keyframe of this run holds.
  [[nodiscard]] const std::string& form() const noexcept { return form_; }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }
  // Null: of a process.
  [[nodiscard]] const ModuleMemory* memory() const noexcept { return memory_; }

  // Runs whose inputs are known and that were not repeated.
  [[nodiscard]] std::uint64_t waited() const noexcept { return waited_; }
  // Doubt: how many runs it lacks. The next run is not in doubt for these.
  std::uint64_t take_missing() noexcept { return std::exchange(missing_, 0); }
  [[nodiscard]] bool has_keyframes() const noexcept {
    return recorded_ && (memory_ != nullptr ? memory_->is_whole() : process_declares_);
  }
  // Why there is no keyframe that could help, for people.
  [[nodiscard]] std::string why_none() const;

 private:
  const ModuleMemory* memory_ = nullptr;
  bool process_declares_ = false;
  bool empty_process_ = false;
  bool recorded_ = false;
  bool renews_ = false;
  std::uint64_t first_ = 0;
  std::uint64_t next_run_ = 0;
  std::uint64_t missing_ = 0;
  std::uint64_t waited_ = 0;
  std::optional<std::uint64_t> keyframe_run_;
  std::string form_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace indurop::node
