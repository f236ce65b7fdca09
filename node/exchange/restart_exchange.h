// SPDX-License-Identifier: Apache-2.0
// The exchange of one process module that no run of another process can follow, because it runs in the background or is
// released by a signal: its process ends, and one with the new file is launched.

#pragma once

#include <cstdint>

#include "node/exchange/program_exchange.h"
#include "scheduler/module_state_text.h"

namespace indurop::node {

class RestartExchange : public ProgramExchange {
 public:
  RestartExchange(ExchangeContext& context, std::uint32_t module, bool held)
      : ProgramExchange(context, module, held, true) {}

  void go_on(rt::MonoTime now) override;
  void go_back() override;
  void end() override;

  void enter(std::uint64_t tick) override { tick_ = tick; }
  void settle() override;
  [[nodiscard]] bool is_ready() const noexcept override { return step_ == Step::Ready; }
  [[nodiscard]] bool has_exchanged() const noexcept override { return step_ == Step::Watched; }
  [[nodiscard]] bool runs_new() const noexcept override { return runs_new_; }
  [[nodiscard]] bool is_over() const noexcept override { return step_ == Step::Over; }
  [[nodiscard]] bool is_prepared() const noexcept override { return step_ >= Step::Ready; }
  [[nodiscard]] bool is_watched() const noexcept override { return step_ == Step::Watched; }
  [[nodiscard]] bool is_open() const noexcept override { return step_ > Step::Ready && step_ < Step::Watched; }

 private:
  enum class Step {
    Preparing,
    Ready,      // it waits for its tick
    Leaving,    // the process is to end
    Launching,  // that of the new version prepares itself
    Returning,  // it is to end, too
    Relaunching,
    Watched,  // it runs
    Over,
  };
  void go_on_checking();
  bool is_wanted(const Candidate& candidate) override;
  void leave(Step to, rt::MonoTime now);
  // Launches one of `other_` when the process has ended.
  void launch_other(Step to, rt::MonoTime now);
  void await_new(rt::MonoTime now);
  void await_previous(rt::MonoTime now);
  void check_health(rt::MonoTime now);
  void go_back(scheduler::Exchange::Reason reason, rt::MonoTime now);
  void conclude();
  // Returns true if the process is ready to run, or has done its work.
  [[nodiscard]] bool is_up() const noexcept { return scheduler::is_up(record().state.load()); }
  [[nodiscard]] bool is_down(rt::MonoTime now) const noexcept;

  Step step_ = Step::Preparing;
  std::uint64_t tick_ = 0;
  bool runs_new_ = false;
  bool is_given_up_ = false;
  Processes::Program other_;  // of the version that does not run
  rt::MonoTime executes_since_{};
  rt::MonoTime deadline_{};                                                 // of this step
  scheduler::Exchange::Reason reason_ = scheduler::Exchange::Reason::None;  // of the way back
};

}  // namespace indurop::node
