// SPDX-License-Identifier: Apache-2.0
// One board's side of a deployment as a state machine: messages and events go in, actions come out. Knows no network,
// files or processes, so every order of events can be tested.

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "core/rt/clock.h"
#include "deploy/transaction/silence.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class BoardTransaction {
 public:
  enum class Do {
    Nothing,
    Fetch,   // fetch what the deployment needs; answer with fetched()
    Check,   // check the plant on this board's copy; answer with checked()
    Load,    // load the modules that differ next to those that run, or only compare; answer with loaded()
    Enter,   // let the node exchange them at switch_at(); answer with exchanged(), then call node()
    Switch,  // end the old node, start the new one; then call node()
    Commit,  // commit the deployment
    GoBack,  // end the new node, start the committed one
    Forget,  // abandon the preparation
  };

  // A deployer that was silent for this time has ended. A loss reported by DDS is weaker evidence: on a busy machine
  // the deployer comes back.
  static constexpr std::chrono::seconds kSilence{5};
  static constexpr std::chrono::milliseconds kClockTrust{100};
  static constexpr std::chrono::seconds kSlowStart{5};  // added to the health window, for nodes that start slowly
  static constexpr std::chrono::seconds kJoinHealth{3};

  // Time that the deployer has to find a board again whose agent became another program in the trial.
  static constexpr std::chrono::seconds kReturn{20};

  explicit BoardTransaction(std::string board) : board_(std::move(board)) {}

  // The agent that switched was another program: this one continues in the trial, or, with a `problem`, reports that
  // the trial has failed and was undone.
  void resume(const Order& order, bool joining, const std::string& problem, rt::MonoTime now);
  // Another board of the plant has committed what this one has in its trial: the decision, should the deployer be gone.
  Do committed_elsewhere(const BoardReport& from);

  // An order of a deployer arrived. One deployment at a time: orders of other deployers are ignored meanwhile.
  Do receive(const Order& order, rt::MonoTime now, rt::WallTime wall);
  // Another board of this board's plant has a newer deployment: this one missed it and takes it over on its own, the
  // given way if it can.
  Do catch_up(const BoardReport& from, rt::MonoTime now, Way way = Way::Restart);
  // An empty problem is success.
  Do fetched(const std::string& problem);
  Do checked(const std::string& problem, rt::MonoTime now);
  // `exchanges`: the node can change to it without a restart.
  Do loaded(const std::string& problem, bool exchanges, rt::MonoTime now);
  Do exchanged(const std::string& problem, rt::MonoTime now);
  // Reports the node of the trial: a permanent `problem`, or what is `missing` for it to be healthy.
  Do node(const std::string& problem, const std::string& missing, rt::MonoTime now);
  // To be called often, as time passes.
  Do time(rt::MonoTime now);

  [[nodiscard]] Phase phase() const noexcept { return phase_; }
  [[nodiscard]] Phase stage() const noexcept { return stage_; }
  [[nodiscard]] const std::string& message() const noexcept { return message_; }
  // How the board can change to the deployment; in the trial and after it, how it did.
  [[nodiscard]] Way way() const noexcept { return way_; }
  // The instant of the switch. Valid with Do::Enter.
  [[nodiscard]] rt::MonoTime switch_at() const noexcept { return switch_.value_or(rt::MonoTime{}); }
  // The deployment that is under way, or was last.
  [[nodiscard]] const Order& order() const noexcept { return order_; }
  [[nodiscard]] bool joining() const noexcept { return joining_; }
  // Session from which to fetch.
  [[nodiscard]] std::uint64_t source() const noexcept { return source_; }
  [[nodiscard]] std::chrono::nanoseconds clock_offset() const noexcept { return clock_offset_; }

 private:
  Do begin(const Order& order, std::uint64_t source, bool joining);
  Do prepared(rt::MonoTime now);
  Do hear_switch(const Order& order, rt::MonoTime now, rt::WallTime wall);
  Do fail(const std::string& problem);
  Do end(const std::string& why);
  [[nodiscard]] bool is_addressed(const Order& order) const;
  void agree_instant(const Order& order, rt::MonoTime now);

  std::string board_;
  Phase phase_ = Phase::Steady;
  Phase stage_ = Phase::Steady;
  Order order_;
  std::uint64_t source_ = 0;
  bool joining_ = false;
  Way way_ = Way::Restart;
  std::string message_;
  std::uint64_t finished_ = 0;     // deployer whose deployment is finished on this board
  std::uint64_t failed_join_ = 0;  // generation that this board failed to take over
  rt::MonoTime retry_;
  Silence silence_;  // of the deployer
  std::chrono::seconds longest_silence_ = kSilence;
  std::optional<rt::MonoTime> switch_;
  rt::MonoTime trial_end_;
  std::chrono::nanoseconds clock_offset_{};
};

}  // namespace indurop::deploy
