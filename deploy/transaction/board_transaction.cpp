// SPDX-License-Identifier: Apache-2.0
#include "deploy/transaction/board_transaction.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::deploy {
namespace {

constexpr std::chrono::seconds kRetry{30};             // after a deployment that could not be taken over
constexpr std::chrono::milliseconds kEnterAhead{100};  // until the tick in which a board that joins exchanges modules
constexpr std::chrono::nanoseconds kLongestHealth = std::chrono::minutes{10};

}  // namespace

using Do = BoardTransaction::Do;

bool BoardTransaction::is_addressed(const Order& order) const {
  return std::find(order.boards.begin(), order.boards.end(), board_) != order.boards.end();
}

Do BoardTransaction::begin(const Order& order, std::uint64_t source, bool joining) {
  order_ = order;
  source_ = source;
  joining_ = joining;
  way_ = Way::Restart;
  phase_ = Phase::Fetching;
  stage_ = Phase::Steady;
  message_.clear();
  switch_.reset();
  return Do::Fetch;
}

void BoardTransaction::resume(const Order& order, bool joining, const std::string& problem, rt::MonoTime now) {
  (void)begin(order, order.deployer, joining && problem.empty());
  silence_ = Silence(now);
  longest_silence_ = problem.empty() ? kReturn : kSilence;
  trial_end_ = now + std::chrono::nanoseconds(order.health_ns);
  phase_ = problem.empty() ? Phase::Trial : joining ? Phase::Steady : Phase::Failed;
  stage_ = problem.empty() ? Phase::Steady : Phase::Trial;
  message_ = problem;
  failed_join_ = joining && !problem.empty() ? order.generation : 0;
}

Do BoardTransaction::committed_elsewhere(const BoardReport& from) {
  // The deployer has seen this board healthy. Its trial may have begun again since then: its agent was killed.
  const bool waits = phase_ == Phase::Healthy || (phase_ == Phase::Trial && !joining_);
  if (!waits || from.current != order_.deployment || from.generation != order_.generation) {
    return Do::Nothing;
  }
  phase_ = Phase::Steady;
  finished_ = order_.deployer;
  return Do::Commit;
}

Do BoardTransaction::fail(const std::string& problem) {
  const bool running = phase_ == Phase::Trial || phase_ == Phase::Healthy;
  stage_ = phase_;
  message_ = problem;
  if (joining_) {
    failed_join_ = order_.generation;
    joining_ = false;
    phase_ = Phase::Steady;
  } else {
    phase_ = Phase::Failed;
  }
  return running ? Do::GoBack : Do::Forget;
}

// Ends the deployment without a commit.
Do BoardTransaction::end(const std::string& why) {
  const Phase before = phase_;
  finished_ = order_.deployer;
  phase_ = Phase::Steady;
  joining_ = false;
  if (before == Phase::Failed) {
    return Do::Nothing;  // everything is undone, and the message says why
  }
  message_ = why;
  return before == Phase::Trial || before == Phase::Healthy ? Do::GoBack : Do::Forget;
}

void BoardTransaction::agree_instant(const Order& order, rt::MonoTime now) {
  // The time until the switch, by the deployer's clock and, if the two clocks agree, by ours: the transport delay does
  // not count then.
  const std::chrono::nanoseconds ahead{order.switch_at_ns - order.said_at_ns};
  const bool trusted = clock_offset_ > -kClockTrust && clock_offset_ < kClockTrust;
  switch_ = now + (trusted ? ahead - clock_offset_ : ahead);
  if (!trusted) {
    message_ = fmt::format("its clock is {:+.1f} s from the deployer's; it switches on the deployer's order instead",
                           std::chrono::duration<double>(clock_offset_).count());
  }
}

Do BoardTransaction::receive(const Order& order, rt::MonoTime now, rt::WallTime wall) {
  if (!is_addressed(order)) {
    return Do::Nothing;
  }
  const bool free = phase_ == Phase::Steady || (joining_ && phase_ != Phase::Trial && phase_ != Phase::Healthy);
  if (free && order.step == Step::Prepare && order.deployer != finished_) {
    silence_ = Silence(now);
    clock_offset_ = wall - rt::wall_time(order.said_at_ns);
    return begin(order, order.deployer, false);
  }
  if (phase_ == Phase::Steady || joining_ || order.deployer != order_.deployer) {
    return Do::Nothing;
  }
  silence_ = Silence(now);
  longest_silence_ = kSilence;
  order_.health_ns = std::clamp<std::int64_t>(order.health_ns, 0, kLongestHealth.count());
  switch (order.step) {
    case Step::Prepare:
      break;
    case Step::Switch:
      if (phase_ == Phase::Prepared && !switch_) {
        return hear_switch(order, now, wall);
      }
      break;
    case Step::Commit:
      if (phase_ == Phase::Trial || phase_ == Phase::Healthy) {
        phase_ = Phase::Steady;
        finished_ = order.deployer;
        return Do::Commit;
      }
      break;
    case Step::Abort:
      return end(order_.way == Way::Compare ? "" : "another board failed, or the deployer gave up");
  }
  return Do::Nothing;
}

Do BoardTransaction::hear_switch(const Order& order, rt::MonoTime now, rt::WallTime wall) {
  if (order.way == Way::Exchange && way_ != Way::Exchange) {
    return fail("it can change to this deployment by a restart of its node only");
  }
  clock_offset_ = wall - rt::wall_time(order.said_at_ns);
  agree_instant(order, now);
  way_ = order.way;
  return way_ == Way::Exchange ? Do::Enter : Do::Nothing;
}

Do BoardTransaction::catch_up(const BoardReport& from, rt::MonoTime now, Way way) {
  if (phase_ != Phase::Steady || (from.generation == failed_join_ && now < retry_)) {
    return Do::Nothing;
  }
  retry_ = now + kRetry;
  Order order;
  order.host = from.board;
  order.plant = from.plant;
  order.deployment = from.current;
  order.grant = from.grant;
  order.size = from.current_size;
  order.generation = from.generation;
  order.boards = from.members;
  order.health_ns = std::chrono::nanoseconds(kJoinHealth).count();
  order.way = way;
  return begin(order, from.agent, true);
}

Do BoardTransaction::fetched(const std::string& problem) {
  if (phase_ != Phase::Fetching) {
    return Do::Nothing;
  }
  if (!problem.empty()) {
    return fail(problem);
  }
  phase_ = Phase::Checking;
  return Do::Check;
}

Do BoardTransaction::checked(const std::string& problem, rt::MonoTime now) {
  if (phase_ != Phase::Checking) {
    return Do::Nothing;
  }
  if (!problem.empty()) {
    return fail(problem);
  }
  return order_.way == Way::Restart ? prepared(now) : Do::Load;
}

Do BoardTransaction::loaded(const std::string& problem, bool exchanges, rt::MonoTime now) {
  if (phase_ != Phase::Checking) {
    return Do::Nothing;
  }
  if (!problem.empty()) {
    return fail(problem);
  }
  way_ = exchanges ? Way::Exchange : Way::Restart;
  return prepared(now);
}

Do BoardTransaction::prepared(rt::MonoTime now) {
  phase_ = Phase::Prepared;
  if (!joining_) {
    return Do::Nothing;
  }
  switch_ = now + (way_ == Way::Exchange ? kEnterAhead : std::chrono::milliseconds(0));
  return way_ == Way::Exchange ? Do::Enter : Do::Nothing;
}

Do BoardTransaction::exchanged(const std::string& problem, rt::MonoTime now) {
  if (phase_ != Phase::Prepared) {
    return Do::Nothing;
  }
  if (!problem.empty()) {
    return fail(problem);
  }
  phase_ = Phase::Trial;
  trial_end_ = now + std::chrono::nanoseconds(order_.health_ns);
  return Do::Nothing;
}

Do BoardTransaction::node(const std::string& problem, const std::string& missing, rt::MonoTime now) {
  if (phase_ != Phase::Trial && phase_ != Phase::Healthy) {
    return Do::Nothing;
  }
  if (!problem.empty()) {
    return fail(problem);
  }
  if (phase_ == Phase::Healthy || now < trial_end_) {
    return Do::Nothing;
  }
  if (joining_) {
    phase_ = Phase::Steady;
    joining_ = false;
    return Do::Commit;  // the plant has committed; that others are missing now is no reason not to
  }
  if (missing.empty()) {
    phase_ = Phase::Healthy;
    return Do::Nothing;
  }
  return now < trial_end_ + kSlowStart ? Do::Nothing : fail(missing);
}

Do BoardTransaction::time(rt::MonoTime now) {
  if (phase_ == Phase::Steady) {
    return Do::Nothing;
  }
  if (!joining_ && silence_.update(now) > longest_silence_) {
    return end(fmt::format("there was no message from the deployer for {} s", longest_silence_.count()));
  }
  if (phase_ == Phase::Prepared && way_ != Way::Exchange && switch_ && now >= *switch_) {
    phase_ = Phase::Trial;
    trial_end_ = now + std::chrono::nanoseconds(order_.health_ns);
    return Do::Switch;
  }
  return Do::Nothing;
}

}  // namespace indurop::deploy
