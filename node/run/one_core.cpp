// SPDX-License-Identifier: Apache-2.0
#include "node/run/one_core.h"

#include <algorithm>

namespace indurop::node {
namespace {

constexpr int kRounds = 500;                              // between two decisions
constexpr std::chrono::microseconds kLongOnAverage{200};  // from this time on a round gains from more cores

}  // namespace

OneCore::OneCore() noexcept {
  CPU_ZERO(&all_);
  CPU_ZERO(&one_);
  (void)::sched_getaffinity(0, sizeof all_, &all_);
  CPU_SET(static_cast<std::size_t>(std::max(::sched_getcpu(), 0)), &one_);
  programs_.push_back(0);  // the caller
}

void OneCore::add(pid_t program) {
  programs_.push_back(program);
  place();
}

void OneCore::round(std::chrono::nanoseconds took) {
  took_ += took;
  if (++rounds_ < kRounds) {
    return;
  }
  const bool gathered = took_ / rounds_ < kLongOnAverage;
  took_ = {};
  rounds_ = 0;
  if (gathered != gathered_) {
    gathered_ = gathered;
    place();
  }
}

// A program that has ended meanwhile is ignored.
void OneCore::place() const noexcept {
  for (const pid_t program : programs_) {
    (void)::sched_setaffinity(program, sizeof(cpu_set_t), gathered_ ? &one_ : &all_);
  }
}

}  // namespace indurop::node
