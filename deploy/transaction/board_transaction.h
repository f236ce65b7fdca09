// SPDX-License-Identifier: Apache-2.0
// One board's side of a deployment as a state machine: what it hears and what happens to it goes in, what it has to do
// comes out. Knows no network, files or processes, so every order of events can be tried.

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "deploy/transaction/silence.h"
#include "deploy/words/deployment_words.h"
#include "rt/clock.h"

namespace indurop::deploy {

class BoardTransaction {
 public:
  enum class Do {
    Nothing,
    Fetch,   // get what the deployment needs; answer with fetched()
    Check,   // check the plant on this board's copy; answer with checked()
    Switch,  // end the old node, start the new one; then tell node()
    Commit,  // make it the committed one
    GoBack,  // end the new node, start the committed one
    Forget,  // give up preparing
  };

  // A deployer not heard for so long has ended. That DDS has lost it says less: on a busy machine it comes back.
  static constexpr std::chrono::seconds kSilence{5};
  static constexpr std::chrono::milliseconds kClockTrust{100};
  static constexpr std::chrono::seconds kSlowStart{5};  // beyond the health window, for what comes up late
  static constexpr std::chrono::seconds kJoinHealth{3};

  explicit BoardTransaction(std::string board) : board_(std::move(board)) {}

  // A deployer said this. One deployment at a time: words of other deployers are not heard meanwhile.
  Do hear(const Order& order, rt::MonoTime now, rt::WallTime wall);
  // Another board of this board's plant has a newer deployment: this one missed it and takes it over by itself.
  Do catch_up(const BoardReport& from, rt::MonoTime now);
  // An empty problem is success.
  Do fetched(const std::string& problem);
  Do checked(const std::string& problem, rt::MonoTime now);
  // The node of the trial: `problem` it has for good, or what `missing` for being well.
  Do node(const std::string& problem, const std::string& missing, rt::MonoTime now);
  // Time passes. Call often.
  Do time(rt::MonoTime now);

  [[nodiscard]] Phase phase() const noexcept { return phase_; }
  [[nodiscard]] Phase stage() const noexcept { return stage_; }
  [[nodiscard]] const std::string& message() const noexcept { return message_; }
  // The deployment that is, or was last, under way.
  [[nodiscard]] const Order& order() const noexcept { return order_; }
  [[nodiscard]] bool joining() const noexcept { return joining_; }
  // From whom to fetch.
  [[nodiscard]] std::uint64_t source() const noexcept { return source_; }
  [[nodiscard]] std::chrono::nanoseconds clock_offset() const noexcept { return clock_offset_; }

 private:
  Do begin(const Order& order, std::uint64_t source, bool joining);
  Do fail(const std::string& problem);
  Do end(const std::string& why);
  [[nodiscard]] bool meant(const Order& order) const;
  void agree_instant(const Order& order, rt::MonoTime now);

  std::string board_;
  Phase phase_ = Phase::Steady;
  Phase stage_ = Phase::Steady;
  Order order_;
  std::uint64_t source_ = 0;
  bool joining_ = false;
  std::string message_;
  std::uint64_t finished_ = 0;     // deployer whose deployment this board is done with
  std::uint64_t failed_join_ = 0;  // generation that could not be taken over
  rt::MonoTime retry_;
  Silence silence_;  // of the deployer
  std::optional<rt::MonoTime> switch_;
  rt::MonoTime trial_end_;
  std::chrono::nanoseconds clock_offset_{};
};

}  // namespace indurop::deploy
