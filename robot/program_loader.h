// SPDX-License-Identifier: Apache-2.0
// Reads the job files anew while the robot stands: a thread beside the tick, which asks, looks in each period whether
// it is done, and takes what came of it. In a simulation the tick reads, so that it is done in the same period on every
// run.

#pragma once

#include <indurop/robot/controller.h>
#include <pthread.h>

#include <atomic>
#include <memory>
#include <string>

#include "robot/program.h"

namespace indurop::robot {

class ProgramLoader {
 public:
  // `urdf`: the arm's description, which has to stay as it is.
  ProgramLoader(const Settings& settings, std::string urdf);
  ProgramLoader(const ProgramLoader&) = delete;
  ProgramLoader& operator=(const ProgramLoader&) = delete;
  ~ProgramLoader();

  // Of the tick, real-time safe: no system call, no lock. Nothing is being read, and nothing is left of it.
  [[nodiscard]] bool free() const noexcept { return state_.load(std::memory_order_acquire) == State::Free; }
  // It is free. `signals` is told of the variables that the jobs name; `present`: those they name now.
  void ask(Signals& signals, const std::vector<std::string>& present) noexcept;
  // Something was asked for and is done. Once a period.
  [[nodiscard]] bool made() noexcept;
  // It is made: what was read, or null and why().
  [[nodiscard]] Program* program() noexcept { return program_.get(); }
  [[nodiscard]] const char* why() const noexcept { return why_.c_str(); }
  // It is made. The thread crashed, and how; else empty.
  [[nodiscard]] const char* crash() const noexcept { return crash_; }
  // The variables are others than before, and `signals` has them ready.
  [[nodiscard]] bool other_signals() const noexcept { return other_signals_; }
  // It is made: the thread may destroy what is left there.
  void give_back() noexcept;

 private:
  // What is read is the tick's in Free and Made, the thread's in the others.
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
