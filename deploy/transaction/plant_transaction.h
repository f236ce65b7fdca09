// SPDX-License-Identifier: Apache-2.0
// The deployer's side of a deployment as a state machine: it receives the boards' reports and commands them until all
// of them have committed or rolled back. Knows no network, so every order of events can be tested.

#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "deploy/transaction/silence.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class PlantTransaction {
 public:
  enum class Verdict {
    Open,         // not decided yet
    Committed,    // on all boards
    Refused,      // a board could not prepare; nothing was switched
    CheckFailed,  // as Refused: a board's check found errors
    Busy,         // another deployment is under way
    RolledBack,   // the new deployment was not healthy; all boards rolled back
    Interrupted,  // cancelled by the user
    Compared,     // all boards have said what they would change, and nothing was
  };

  static constexpr std::chrono::milliseconds kSwitchAhead{300};
  static constexpr std::chrono::seconds kBusy{3};  // time another deployer has to give way
  static constexpr std::chrono::seconds kWindUp{10};
  static constexpr std::chrono::seconds kLost{3};

  // `order` without step and times: deployer, host, deployment, size, generation, boards, health, the way that is
  // wanted. `patience`: maximum time without any event while boards prepare. `lost`: time a board that the network has
  // lost has to come back.
  PlantTransaction(Order order, std::chrono::nanoseconds patience, rt::MonoTime now,
                   std::chrono::nanoseconds lost = kLost);

  void receive(const BoardReport& report, rt::MonoTime now);
  // The network has lost a board. It is waited for a while: on a busy machine it comes back.
  void board_lost(const std::string& board, std::uint64_t agent, rt::MonoTime now);
  // Another deployer sends orders to some of the same boards: the one with the smaller number continues.
  void rival(const Order& order, rt::MonoTime now);
  void give_up(rt::MonoTime now);
  // To be called often; returns true if the order to publish has changed since the last call, in whatever function.
  bool time(rt::MonoTime now, rt::WallTime wall);

  // The order to publish now.
  [[nodiscard]] const Order& order() const noexcept { return order_; }
  // Returns true when there is nothing more to publish: all boards are done, or those that answer.
  [[nodiscard]] bool finished() const noexcept { return finished_; }
  [[nodiscard]] Verdict verdict() const noexcept { return verdict_; }
  [[nodiscard]] const std::map<std::string, BoardReport>& reports() const noexcept { return reports_; }
  // Per board, why it failed. Boards that only rolled back with the others are not included.
  [[nodiscard]] const std::map<std::string, std::string>& reasons() const noexcept { return reasons_; }
  // Boards that have not confirmed the last step.
  [[nodiscard]] const std::vector<std::string>& unconfirmed() const noexcept { return unconfirmed_; }

 private:
  void abort(Verdict verdict, const std::string& board, const std::string& reason, rt::MonoTime now);
  void miss_lost(rt::MonoTime now);
  void judge(const std::string& board, const BoardReport& report, rt::MonoTime now);
  void all_are_prepared(rt::MonoTime now, rt::WallTime wall);
  [[nodiscard]] bool all_in(Phase phase) const;
  [[nodiscard]] bool all_have_ended();
  [[nodiscard]] bool ours(const BoardReport& report) const noexcept { return report.deployer == order_.deployer; }

  Order order_;
  std::chrono::nanoseconds patience_;
  std::chrono::nanoseconds lost_patience_;
  rt::MonoTime moved_;   // time of the last event
  rt::MonoTime ending_;  // when Commit or Abort was published
  bool switched_ = false;
  bool finished_ = false;
  Step published_ = Step::Prepare;  // of the order when time() returned last
  Verdict verdict_ = Verdict::Open;
  std::map<std::string, BoardReport> reports_;  // of the addressed boards, newest
  std::map<std::string, Silence> lost_;         // addressed boards that are lost, with the time of silence
  std::map<std::string, rt::MonoTime> busy_since_;
  std::map<std::string, std::string> reasons_;
  std::vector<std::string> unconfirmed_;
};

}  // namespace indurop::deploy
