// SPDX-License-Identifier: Apache-2.0
// This process as a periodic or sporadic module of a node: finds its slot in the run block, waits for releases, detects
// that the node has ended, and finds the next one.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "scheduler/run_block.h"
#include "store/runtime/kept_thread.h"
#include "store/runtime/run_mapping.h"
#include "store/tape/member.h"
#include "store/tape/replay_input.h"

namespace indurop::runtime {

class Enrolment {
 public:
  static Enrolment& get();

  // First enrolment, with messages. Errors as irp::initPeriodExe().
  Status begin();
  // As irp::waitPeriod().
  bool wait();
  // Cheap check whether this process should end; for modules that never wait.
  bool stop_requested() noexcept;

  // Tick of the current release; 0 before the first.
  [[nodiscard]] std::uint64_t release_tick() const noexcept { return release_tick_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t release_ns() const noexcept { return release_ns_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool enrolled() const noexcept { return phase_ != Phase::None; }

 private:
  enum class Phase {
    None,      // initPeriodExe() not called
    NoNode,    // called, but there is no node to enrol with
    Prepared,  // this process's slot is known
    Turn,      // another process of this module runs; this one waits until it may follow it
    Enrolled,  // and the node releases it
    Ending,    // waitPeriod() has returned false
  };
  enum class Again { No, Yes };

  static constexpr std::int64_t kIdleNs = 100'000'000;  // interval at which a waiting process checks its node

  // The message of a rejected enrolment: the reason, and what to do.
  struct Outcome {
    Errc code = Errc::Ok;
    std::string text;
  };
  Outcome enrol(Again again);
  Outcome take_slot(RunMapping& mapping, Again again);
  void publish();
  void follow();
  bool take_over(const tape::ProcessKeyframes* theirs);
  void wait_for_turn();
  [[nodiscard]] bool has_run_last() const noexcept;
  void pass_on();
  void give_way();
  void wait_for_hand_over(std::int32_t other, const tape::ProcessKeyframes* keyframes);
  void open_tape();
  void start_keyframes();
  void close_records();
  static void take_priority(const scheduler::ModuleRecord& record);
  static void lock_memory(const scheduler::RunBlock& run, const scheduler::ModuleRecord& record);
  void finish_run() noexcept;
  bool take_release() noexcept;
  void check_node();
  void try_again();

  Phase phase_ = Phase::None;
  std::string node_;
  RunMapping* mapping_ = nullptr;
  scheduler::ProcessSlot* slot_ = nullptr;
  std::optional<tape::Member> tape_;                     // none: the node has no tape
  std::optional<tape::ReplayInputReader> replay_input_;  // the node is a replay
  std::unique_ptr<KeptThread> kept_;                     // null: the module does not declare what it keeps
  std::int32_t pid_ = 0;
  std::int32_t holder_ = 0;       // pid of the previous holder of the slot
  std::int32_t enrolled_as_ = 0;  // pid under which the node knows this process
  std::uint64_t seen_ = 0;        // last release handled
  bool running_ = false;
  int exit_code_ = 0;
  bool end_wanted_ = false;
  unsigned idle_ = 0;  // consecutive waits that no release ended
  std::atomic<std::uint64_t> release_tick_{0};
  std::atomic<std::int64_t> release_ns_{0};
  std::atomic<std::int64_t> next_check_ns_{0};
};

}  // namespace indurop::runtime
