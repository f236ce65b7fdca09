// SPDX-License-Identifier: Apache-2.0
#include "mirror/joining.h"

#include "rt/clock.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kRetryNs = 500'000'000;

}  // namespace

bool Joining::try_once(std::string& problem) {
  joined_ = join_plant(settings_, problem);
  if (!joined_.participant.ok()) {
    return false;
  }
  if (!open_(joined_.participant.get(), problem)) {
    leave();
    return false;
  }
  return true;
}

bool Joining::join(const std::atomic<bool>& stop, rt::SignalWord& wake, SharedText& problem) {
  while (!stop.load(std::memory_order_acquire)) {
    std::string why;
    const bool done = try_once(why);
    problem.set(why);
    if (done) {
      return true;
    }
    wake.wait_until(rt::now_ns() + kRetryNs);
  }
  return false;
}

void Joining::leave() noexcept {
  if (joined_.participant.ok()) {
    close_();
  }
  joined_.participant.reset();
  joined_.domain.reset();
}

}  // namespace indurop::mirror
