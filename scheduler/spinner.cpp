// SPDX-License-Identifier: Apache-2.0
#include "scheduler/spinner.h"

#include <algorithm>

#include "rt/relax.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kFirstGuess = 20'000;
// Steps up and down in the ratio 100 : 1, so the estimate settles where 1 % of the wake-ups are later.
constexpr std::int64_t kStepUp = 400;
constexpr std::int64_t kStepDown = 4;

}  // namespace

Spinner::Spinner(Clock& clock, const SpinSettings& settings, std::int64_t period_ns) noexcept
    : clock_(clock), mode_(settings.mode), limit_(std::min(period_ns / 2, kMostSpinNs)), quantile_(kFirstGuess) {
  if (mode_ == SpinMode::Auto) {
    margin_ = std::min(kFirstGuess, limit_);
  } else if (mode_ == SpinMode::Fixed) {
    margin_ = std::min(settings.fixed_ns, period_ns);
  }
}

void Spinner::learn(std::int64_t wake_cost) noexcept {
  quantile_ += wake_cost > quantile_ ? kStepUp : -kStepDown;
  margin_ = std::min(quantile_ + quantile_ * 15 / 100 + 1000, limit_);
}

rt::MonoTime Spinner::wait_until(rt::MonoTime deadline) noexcept {
  rt::MonoTime now = clock_.now();
  const rt::MonoTime wake_at = deadline - std::chrono::nanoseconds(margin_);
  if (now < wake_at) {
    clock_.sleep_until(wake_at);
    now = clock_.now();
    if (mode_ == SpinMode::Auto) {
      learn((now - wake_at).count());
    }
  }
  while (now < deadline) {
    rt::relax();
    now = clock_.now();
  }
  return now;
}

}  // namespace indurop::scheduler
