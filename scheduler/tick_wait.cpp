// SPDX-License-Identifier: Apache-2.0
#include "scheduler/tick_wait.h"

#include <algorithm>

#include "core/rt/relax.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kFirstGuess = 20'000;
// Steps up and down in the ratio 100 : 1, so the estimate settles where 1 % of the wake-ups are later.
constexpr std::int64_t kStepUp = 400;
constexpr std::int64_t kStepDown = 4;
// Number of ticks within which spinning beyond the budget is saved again.
constexpr std::int64_t kSettle = 64;

}  // namespace

TickWait::TickWait(Clock& clock, const SpinSettings& settings, std::int64_t period_ns) noexcept
    : clock_(clock),
      mode_(settings.mode),
      limit_(std::min(period_ns / 2, kMaxSpinNs)),
      budget_(std::min(period_ns / kMaxMeanShare, kMaxMeanNs)),
      credit_(kFirstGuess * kSettle),
      quantile_(kFirstGuess) {
  if (mode_ == SpinMode::Auto) {
    margin_ = std::min(kFirstGuess, limit_);
  } else if (mode_ == SpinMode::Fixed) {
    margin_ = std::min(settings.fixed_ns, period_ns);
  }
}

void TickWait::learn(std::int64_t wake_cost, std::int64_t spin) noexcept {
  quantile_ += wake_cost > quantile_ ? kStepUp : -kStepDown;
  const std::int64_t wanted = std::min(quantile_ + quantile_ * 15 / 100 + 1000, limit_);
  // Limits the credit to what will be needed soon: a machine that becomes slow must not use it all at once.
  credit_ = std::clamp<std::int64_t>(credit_ + budget_ - spin, 0, 2 * wanted * kSettle);
  margin_ = std::min(wanted, credit_ / kSettle);
}

rt::MonoTime TickWait::wait_until(rt::MonoTime deadline) noexcept {
  rt::MonoTime now = clock_.now();
  const rt::MonoTime wake_at = deadline - std::chrono::nanoseconds(margin_);
  if (now < wake_at) {
    clock_.sleep_until(wake_at);
    now = clock_.now();
    if (mode_ == SpinMode::Auto) {
      learn((now - wake_at).count(), std::max<std::int64_t>((deadline - now).count(), 0));
    }
  }
  while (now < deadline) {
    rt::relax();
    now = clock_.now();
  }
  return now;
}

}  // namespace indurop::scheduler
