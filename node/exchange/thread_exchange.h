// SPDX-License-Identifier: Apache-2.0
// The exchange of a thread module up to the moment at which its new version could run: that is loaded and started in
// this process, next to the one that runs.

#pragma once

#include <memory>
#include <string>

#include "node/exchange/candidate_thread.h"
#include "node/exchange/version_exchange.h"
#include "scheduler/module_state_text.h"

namespace indurop::node {

class ThreadExchange : public VersionExchange {
 public:
  void begin(const operate::ReloadRequest& request) override;

 protected:
  ThreadExchange(ExchangeContext& context, std::uint32_t module, bool held) : VersionExchange(context, module, held) {}

  static constexpr const char* kRunsNoMore = "the version that runs has faulted or was stopped meanwhile";

  // How far the preparation is.
  enum class Progress {
    Working,
    Answered,  // there will be no new version
    GivenUp,   // `failure_` says why
    Ready,
  };
  Progress prepare(rt::MonoTime now);
  // Waits for calls in progress. Returns false if there is no new version yet.
  bool end_preparation();
  // Whether the new version would run now, if it were exchanged.
  [[nodiscard]] bool would_run() const noexcept { return scheduler::is_up(record().state.load()); }
  [[nodiscard]] ModuleLibrary& running() const noexcept { return context_.parts.libraries[module_]; }

  // NOLINTBEGIN(cppcoreguidelines-non-private-member-variables-in-classes,misc-non-private-member-variables-in-classes)
  ModuleLibrary other_;  // the version that does not run
  Carry carry_;
  VariableChange variables_;       // that the version which does not run brings
  bool is_started_ = false;        // start() of the new version was called
  bool other_is_unsound_ = false;  // it was left in the middle of a run
  std::string failure_;            // why the exchange was given up; empty: it was not
  // NOLINTEND(cppcoreguidelines-non-private-member-variables-in-classes,misc-non-private-member-variables-in-classes)

 private:
  bool take_candidate();
  bool is_wanted(const Candidate& candidate);
  void start_other();

  std::unique_ptr<CandidateThread> preparation_;
  Phases::CallPointer call_{nullptr, [](Phases::Call* /*none*/) {}};
};

}  // namespace indurop::node
