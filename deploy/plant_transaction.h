// SPDX-License-Identifier: Apache-2.0
// The deployer's side of a deployment as a state machine: it hears what the boards report and says what they are to do
// until all of them have committed or gone back. Knows no network, so every order of events can be tried.

#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "deploy/deployment_words.h"

namespace indurop::deploy {

class PlantTransaction {
 public:
  enum class Verdict {
    Open,         // not decided yet
    Committed,    // on all boards
    Refused,      // a board could not prepare; nothing was switched
    CheckFailed,  // likewise, its check found errors
    Busy,         // another deployment is under way
    RolledBack,   // the new deployment did not do; all boards went back
    Interrupted,  // given up by the user
  };

  static constexpr std::int64_t kSwitchAheadNs = 300'000'000;
  static constexpr std::int64_t kBusyNs = 3'000'000'000;  // how long another deployer may take to give way
  static constexpr std::int64_t kWindUpNs = 10'000'000'000;

  // `order` without step and times: deployer, host, deployment, size, generation, boards, health. `patience_ns`: how
  // long nothing at all may happen while boards prepare.
  PlantTransaction(Order order, std::int64_t patience_ns, std::int64_t now_ns);

  void hear(const BoardReport& report, std::int64_t now_ns);
  void board_gone(const std::string& board, std::uint64_t agent, std::int64_t now_ns);
  // Another deployer speaks to some of the same boards: the one with the smaller number goes on.
  void rival(const Order& order, std::int64_t now_ns);
  void give_up(std::int64_t now_ns);
  // Call often; true if the order to publish has changed.
  bool time(std::int64_t now_ns, std::int64_t wall_ns);

  // What to say to the boards now.
  [[nodiscard]] const Order& order() const noexcept { return order_; }
  // Nothing more to say: all boards are done, or those that answer.
  [[nodiscard]] bool finished() const noexcept { return finished_; }
  [[nodiscard]] Verdict verdict() const noexcept { return verdict_; }
  [[nodiscard]] const std::map<std::string, BoardReport>& reports() const noexcept { return reports_; }
  // Per board, why it did not do. Boards that only went back with the others are not in it.
  [[nodiscard]] const std::map<std::string, std::string>& reasons() const noexcept { return reasons_; }
  // Boards that have not answered to the last step.
  [[nodiscard]] const std::vector<std::string>& unconfirmed() const noexcept { return unconfirmed_; }

 private:
  void abort(Verdict verdict, const std::string& board, const std::string& reason, std::int64_t now_ns);
  void judge(const std::string& board, const BoardReport& report, std::int64_t now_ns);
  [[nodiscard]] bool all_in(Phase phase) const;
  [[nodiscard]] bool wound_up();
  [[nodiscard]] bool ours(const BoardReport& report) const noexcept { return report.deployer == order_.deployer; }

  Order order_;
  std::int64_t patience_ns_;
  std::int64_t moved_ns_;       // when something happened last
  std::int64_t ending_ns_ = 0;  // when Commit or Abort was said
  bool switched_ = false;
  bool finished_ = false;
  Verdict verdict_ = Verdict::Open;
  std::map<std::string, BoardReport> reports_;  // of the boards meant, newest
  std::set<std::string> gone_;                  // of those, not heard any more
  std::map<std::string, std::int64_t> busy_since_;
  std::map<std::string, std::string> reasons_;
  std::vector<std::string> unconfirmed_;
};

}  // namespace indurop::deploy
