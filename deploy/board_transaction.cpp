// SPDX-License-Identifier: Apache-2.0
#include "deploy/board_transaction.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::deploy {
namespace {

constexpr std::int64_t kRetryNs = 30'000'000'000;  // after a deployment that could not be taken over
constexpr std::int64_t kLongestHealthNs = 600'000'000'000;

}  // namespace

using Do = BoardTransaction::Do;

bool BoardTransaction::meant(const Order& order) const {
  return std::find(order.boards.begin(), order.boards.end(), board_) != order.boards.end();
}

Do BoardTransaction::begin(const Order& order, std::uint64_t source, bool joining) {
  order_ = order;
  source_ = source;
  joining_ = joining;
  phase_ = Phase::Fetching;
  stage_ = Phase::Steady;
  message_.clear();
  switch_ns_.reset();
  return Do::Fetch;
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

// The deployment is over without a commit.
Do BoardTransaction::end(const std::string& why) {
  const Phase before = phase_;
  finished_ = order_.deployer;
  phase_ = Phase::Steady;
  joining_ = false;
  if (before == Phase::Failed) {
    return Do::Nothing;  // all is undone, and the message says why
  }
  message_ = why;
  return before == Phase::Trial || before == Phase::Healthy ? Do::GoBack : Do::Forget;
}

void BoardTransaction::agree_instant(const Order& order, std::int64_t now_ns) {
  // How long from now, by the deployer's clock and, if the two clocks agree, by ours: the way here does not count then.
  const std::int64_t ahead = order.switch_at_ns - order.said_at_ns;
  const bool trusted = clock_offset_ns_ > -kClockTrustNs && clock_offset_ns_ < kClockTrustNs;
  switch_ns_ = now_ns + (trusted ? ahead - clock_offset_ns_ : ahead);
  if (!trusted) {
    message_ = fmt::format("its clock is {:+.1f} s from the deployer's; it switches by the deployer's word instead",
                           static_cast<double>(clock_offset_ns_) / 1e9);
  }
}

Do BoardTransaction::hear(const Order& order, std::int64_t now_ns, std::int64_t wall_ns) {
  if (!meant(order)) {
    return Do::Nothing;
  }
  const bool free = phase_ == Phase::Steady || (joining_ && phase_ != Phase::Trial && phase_ != Phase::Healthy);
  if (free && order.step == Step::Prepare && order.deployer != finished_) {
    heard_ns_ = now_ns;
    clock_offset_ns_ = wall_ns - order.said_at_ns;
    return begin(order, order.deployer, false);
  }
  if (phase_ == Phase::Steady || joining_ || order.deployer != order_.deployer) {
    return Do::Nothing;
  }
  heard_ns_ = now_ns;
  order_.health_ns = std::clamp<std::int64_t>(order.health_ns, 0, kLongestHealthNs);
  switch (order.step) {
    case Step::Prepare:
      break;
    case Step::Switch:
      if (phase_ == Phase::Prepared && !switch_ns_) {
        clock_offset_ns_ = wall_ns - order.said_at_ns;
        agree_instant(order, now_ns);
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
      return end("another board could not, or the deployer gave up");
  }
  return Do::Nothing;
}

Do BoardTransaction::deployer_gone(std::uint64_t deployer) {
  if (phase_ == Phase::Steady || joining_ || deployer != order_.deployer) {
    return Do::Nothing;
  }
  return end("the deployer ended before it was done");
}

Do BoardTransaction::catch_up(const BoardReport& from, std::int64_t now_ns) {
  if (phase_ != Phase::Steady || (from.generation == failed_join_ && now_ns < retry_ns_)) {
    return Do::Nothing;
  }
  retry_ns_ = now_ns + kRetryNs;
  Order order;
  order.host = from.board;
  order.plant = from.plant;
  order.deployment = from.current;
  order.grant = from.grant;
  order.size = from.current_size;
  order.generation = from.generation;
  order.boards = from.members;
  order.health_ns = kJoinHealthNs;
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

Do BoardTransaction::checked(const std::string& problem, std::int64_t now_ns) {
  if (phase_ != Phase::Checking) {
    return Do::Nothing;
  }
  if (!problem.empty()) {
    return fail(problem);
  }
  phase_ = Phase::Prepared;
  if (joining_) {
    switch_ns_ = now_ns;
  }
  return Do::Nothing;
}

Do BoardTransaction::node(const std::string& problem, const std::string& missing, std::int64_t now_ns) {
  if (phase_ != Phase::Trial && phase_ != Phase::Healthy) {
    return Do::Nothing;
  }
  if (!problem.empty()) {
    return fail(problem);
  }
  if (phase_ == Phase::Healthy || now_ns < trial_end_ns_) {
    return Do::Nothing;
  }
  if (joining_) {
    phase_ = Phase::Steady;
    joining_ = false;
    return Do::Commit;  // the plant has it already; that others are missing now is no reason to stay behind
  }
  if (missing.empty()) {
    phase_ = Phase::Healthy;
    return Do::Nothing;
  }
  return now_ns < trial_end_ns_ + kSlowStartNs ? Do::Nothing : fail(missing);
}

Do BoardTransaction::time(std::int64_t now_ns) {
  if (phase_ == Phase::Steady) {
    return Do::Nothing;
  }
  if (!joining_ && now_ns - heard_ns_ > kSilenceNs) {
    return end(fmt::format("the deployer was not heard for {} s", kSilenceNs / 1'000'000'000));
  }
  if (phase_ == Phase::Prepared && switch_ns_ && now_ns >= *switch_ns_) {
    phase_ = Phase::Trial;
    trial_end_ns_ = now_ns + order_.health_ns;
    return Do::Switch;
  }
  return Do::Nothing;
}

}  // namespace indurop::deploy
