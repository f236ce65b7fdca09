// SPDX-License-Identifier: Apache-2.0
// The exchange of one process module while the node runs: a process with the new file is launched next to the one that
// runs, follows it between two runs, and is watched for a while, in which the previous one waits. Called by the thread
// that supervises the node.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "node/exchange/module_exchange.h"
#include "store/tape/process_keyframes.h"

namespace indurop::node {

class ProcessExchange {
 public:
  ProcessExchange(ExchangeContext& context, std::uint32_t module);
  ProcessExchange(const ProcessExchange&) = delete;
  ProcessExchange& operator=(const ProcessExchange&) = delete;
  ~ProcessExchange() = default;

  void begin(const operate::ReloadRequest& request);
  // Continues it.
  void go_on(rt::MonoTime now);
  // By command, while it is watched: the previous process is to run again.
  void go_back();
  // The node ends; the process that runs has been ended.
  void end();

  [[nodiscard]] bool is_over() const noexcept { return step_ == Step::Over; }
  // Returns true if the new process runs, and the previous one is ready.
  [[nodiscard]] bool is_watched() const noexcept { return step_ == Step::Watched; }
  [[nodiscard]] bool has_answered() const noexcept { return answered_; }

 private:
  enum class Step {
    Preparing,  // the file is checked, on a thread of its own
    Starting,   // the new process prepares itself
    Ready,      // it waits for the macro period in which it may follow
    Following,  // it follows after the run of the other one
    Watched,    // it runs; the previous one is ready
    Returning,  // the previous one follows it
    Ending,     // the process that runs no more ends
    Over,
  };
  // A process of this module that the node does not supervise: the next one, or the previous one.
  struct Other {
    pid_t pid = -1;  // -1: none, or it has ended
    int status = 0;  // of its end
    std::filesystem::path file;
    std::string digest;
  };

  void prepared();
  // Returns false if it was answered that nothing is exchanged.
  bool is_wanted(const Candidate& candidate);
  void launch();
  // What a process of this module keeps; nothing: it does not declare it.
  [[nodiscard]] std::optional<std::string> form_of(tape::ProcessKeyframes::Of of) const;
  void compare(rt::MonoTime now);
  void await_ready(rt::MonoTime now);
  void let_follow(rt::MonoTime now);
  void await_follow(rt::MonoTime now);
  void note_exchanged(rt::MonoTime now);
  // Why the process that runs is not a good one.
  [[nodiscard]] std::optional<scheduler::Exchange::Reason> fault() const;
  void check_health(rt::MonoTime now);
  void go_back(scheduler::Exchange::Reason reason, rt::MonoTime now);
  void await_return(rt::MonoTime now);
  void report_return();
  // Ends the other process.
  void leave(rt::MonoTime now);
  void await_end(rt::MonoTime now);
  void abort(const std::string& why, rt::MonoTime now);
  void answer(scheduler::CommandResult result, const std::string& text);
  void set_version(scheduler::VersionState state);
  // The other one runs from now on, and the one that ran becomes the other one.
  void swap();
  [[nodiscard]] bool has_ended(Other& other) const;
  [[nodiscard]] scheduler::ModuleRecord& record() const noexcept { return context_.parts.run.modules()[module_]; }
  [[nodiscard]] scheduler::ProcessSlot& slot() const noexcept { return context_.parts.run.process_slots()[module_]; }

  ExchangeContext& context_;
  Processes& processes_;
  std::uint32_t module_;
  Step step_ = Step::Preparing;
  operate::ReloadRequest request_;
  operate::ReloadReport report_;
  bool answered_ = false;
  std::optional<GuardCondition> guard_;
  std::unique_ptr<CandidateThread> preparation_;
  Other other_;
  std::string digest_;           // of the file of the process that runs
  std::uint64_t follow_in_ = 0;  // tick
  rt::MonoTime deadline_{};      // of this step
  bool was_asked_ = false;       // the other one to end
  std::uint64_t skipped_before_ = 0;
  std::uint64_t overruns_before_ = 0;
  std::uint64_t judged_from_ = 0;  // tick after which an overrun is one of the new process
  scheduler::Exchange::Reason reason_ = scheduler::Exchange::Reason::None;  // of the way back
};

}  // namespace indurop::node
