// SPDX-License-Identifier: Apache-2.0
// The exchange of a process module up to the moment at which a process of the new version may be launched.

#pragma once

#include <memory>

#include "node/exchange/candidate_thread.h"
#include "node/exchange/version_exchange.h"

namespace indurop::node {

class ProgramExchange : public VersionExchange {
 public:
  void begin(const operate::ReloadRequest& request) override;

 protected:
  // `ends_first`: the process that runs ends before the new one is launched.
  ProgramExchange(ExchangeContext& context, std::uint32_t module, bool held, bool ends_first)
      : VersionExchange(context, module, held), processes_(context.parts.processes), ends_first_(ends_first) {}

  // How far the check of its file is.
  enum class Progress {
    Working,
    Answered,  // there will be no new version
    Ready,     // its variables are there
  };
  Progress check();
  // The new version is not wanted any more, while its file is checked.
  void give_up() noexcept { is_given_up_ = true; }
  // Waits for a check in progress.
  void end_check();
  // Another version runs from now on: the one of `uses_`, which becomes that of the version before.
  void swap_uses();
  // If the file of the program was replaced, as it often is by that of the next version, the copy that the node keeps
  // takes its place.
  void find_kept(Processes::Program& program) const;

  // NOLINTBEGIN(cppcoreguidelines-non-private-member-variables-in-classes,misc-non-private-member-variables-in-classes)
  Processes& processes_;
  Processes::Program checked_;  // of the new version
  VariableChange variables_;    // that it brings
  // NOLINTEND(cppcoreguidelines-non-private-member-variables-in-classes,misc-non-private-member-variables-in-classes)

 private:
  // Returns false if it was answered that nothing is exchanged. The file is good, and another one than that which runs.
  virtual bool is_wanted(const Candidate& candidate) = 0;
  [[nodiscard]] bool is_changed(const Candidate& candidate);

  bool ends_first_;
  bool is_given_up_ = false;
  std::unique_ptr<CandidateThread> preparation_;
  ModuleLibrary::Uses uses_;  // of the version that does not run
};

}  // namespace indurop::node
