// SPDX-License-Identifier: Apache-2.0
// Reads the job files again while the robot is at standstill: a background thread does it; the tick requests it, polls
// in each period until it is done, and takes the result. In a simulation the tick itself reads, so that it is done in
// the same period on every run.

#pragma once

#include <indurop/robot/controller.h>
#include <pthread.h>

#include <atomic>
#include <memory>
#include <string>

#include "control/robot/files/program.h"

namespace indurop::robot {

class ProgramLoader {
 public:
  // `urdf`: the arm's description, which must not change.
  ProgramLoader(const Settings& settings, std::string urdf);
  ProgramLoader(const ProgramLoader&) = delete;
  ProgramLoader& operator=(const ProgramLoader&) = delete;
  ~ProgramLoader();

  // Called by the tick, real-time safe: no system call, no lock. Returns whether nothing is being read and no result is
  // left.
  [[nodiscard]] bool free() const noexcept { return state_.load(std::memory_order_acquire) == State::Free; }
  // Requests a reload; requires free(). `signals` receives the variables that the jobs name; `present`: those that they
  // name now.
  void ask(Signals& signals, const std::vector<std::string>& present) noexcept;
  // Returns whether a requested reload is done. Called once per period.
  [[nodiscard]] bool made() noexcept;
  // After made(): what was read, or null and the reason in why().
  [[nodiscard]] Program* program() noexcept { return program_.get(); }
  [[nodiscard]] const char* why() const noexcept { return why_.c_str(); }
  // After made(): how the thread crashed; empty if it did not.
  [[nodiscard]] const char* crash() const noexcept { return crash_; }
  // Returns whether the variables differ from the earlier ones; `signals` has them ready.
  [[nodiscard]] bool other_signals() const noexcept { return other_signals_; }
  // After made(): returns the result; the thread may destroy it.
  void give_back() noexcept;

 private:
  // The owner of the result: the tick in Free and Made, the thread in the other states.
  enum class State { Free, Asked, Made, Spent };

  void read() noexcept;
  void run() noexcept;
  void look_for_work() noexcept;
  static void* enter(void* loader) noexcept;

  FileNames names_;
  std::string urdf_;
  bool in_tick_;
  bool (*learned_)(bool what) noexcept;
  decltype(Settings::guarded) guarded_;
  Signals* signals_ = nullptr;
  const std::vector<std::string>* present_ = nullptr;
  std::unique_ptr<Program> program_;
  std::string why_;
  bool other_signals_ = false;
  char crash_[96] = "";
  std::atomic<State> state_{State::Free};
  std::atomic<bool> ending_{false};
  pthread_t thread_{};
};

}  // namespace indurop::robot
