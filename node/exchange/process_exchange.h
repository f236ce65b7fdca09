// SPDX-License-Identifier: Apache-2.0
// The exchange of one process module while the node runs: a process with the new file is launched next to the one that
// runs, and the previous one waits while it is watched.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "node/exchange/program_exchange.h"
#include "store/tape/process_keyframes.h"

namespace indurop::node {

class ProcessExchange : public ProgramExchange {
 public:
  ProcessExchange(ExchangeContext& context, std::uint32_t module, bool held);

  void go_on(rt::MonoTime now) override;
  void go_back() override;
  void end() override;

  void enter(std::uint64_t tick) override { follow_from_ = tick; }
  void settle() override;
  [[nodiscard]] bool is_ready() const noexcept override { return step_ == Step::Ready; }
  [[nodiscard]] bool has_exchanged() const noexcept override { return step_ == Step::Watched; }
  [[nodiscard]] bool runs_new() const noexcept override { return runs_new_; }
  [[nodiscard]] bool is_over() const noexcept override { return step_ == Step::Over; }
  [[nodiscard]] bool is_prepared() const noexcept override { return step_ >= Step::Ready; }
  [[nodiscard]] bool is_watched() const noexcept override { return step_ == Step::Watched; }
  [[nodiscard]] bool is_open() const noexcept override { return false; }

 private:
  enum class Step {
    Preparing,
    Starting,   // the new process prepares itself
    Ready,      // it waits for the tick from which on it may follow
    Following,  // it executes the runs from that tick on
    Watched,    // it runs; the previous one is ready
    Returning,  // the previous one follows it
    Ending,     // the process that runs no more ends
    Over,
  };
  // A process of this module that the node does not supervise: the next one, or the previous one.
  struct Other {
    pid_t pid = -1;  // -1: none, or it has ended
    int status = 0;  // of its end
    Processes::Program program;
  };

  static constexpr const char* kProcessRunsNoMore = "the process that runs has faulted or was stopped meanwhile";

  void go_on_checking();
  bool is_wanted(const Candidate& candidate) override;
  void launch();
  void compare(rt::MonoTime now);
  void await_ready(rt::MonoTime now);
  void let_follow(rt::MonoTime now);
  void await_follow(rt::MonoTime now);
  [[nodiscard]] bool has_run() const noexcept;
  void note_exchanged(rt::MonoTime now);
  // An overrun is a reason to return.
  [[nodiscard]] bool is_judged() const noexcept { return held_ || request_.health_ns > 0; }
  // Why the process that runs is not a good one.
  [[nodiscard]] std::optional<scheduler::Exchange::Reason> fault() const;
  void check_health(rt::MonoTime now);
  void go_back(scheduler::Exchange::Reason reason, rt::MonoTime now);
  void await_return(rt::MonoTime now);
  // Ends the other process.
  void leave(rt::MonoTime now);
  void await_end(rt::MonoTime now);
  void abort(const std::string& why, rt::MonoTime now);
  // The same if the other one may have followed.
  void withdraw(const std::string& why, rt::MonoTime now);
  // The other one runs from now on, and the one that ran becomes the other one.
  void swap();
  [[nodiscard]] bool has_ended(Other& other) const;
  [[nodiscard]] scheduler::ProcessSlot& slot() const noexcept { return context_.parts.run.process_slots()[module_]; }

  Step step_ = Step::Preparing;
  bool runs_new_ = false;
  Other other_;
  Processes::Program running_;     // of the process that runs
  std::uint64_t follow_from_ = 0;  // tick
  rt::MonoTime deadline_{};        // of this step
  bool was_asked_ = false;         // the other one to end
  std::uint64_t skipped_before_ = 0;
  std::uint64_t overruns_before_ = 0;
  std::uint64_t judged_from_ = 0;  // tick after which an overrun is one of the new process
  scheduler::Exchange::Reason reason_ = scheduler::Exchange::Reason::None;  // of the way back
};

}  // namespace indurop::node
