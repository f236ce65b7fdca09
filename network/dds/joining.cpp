// SPDX-License-Identifier: Apache-2.0
#include "network/dds/joining.h"

#include "core/rt/clock.h"

namespace indurop::dds {
namespace {

constexpr std::chrono::milliseconds kRetry{500};

}  // namespace

Result<std::string, base::Problem> Joining::try_once() {
  auto joined = join_network(settings_);
  if (!joined) {
    return std::move(joined).error();
  }
  participant_ = std::move(joined->participant);
  if (auto opened = open_(participant_.get()); !opened) {
    leave();
    return std::move(opened).error();
  }
  return std::move(joined->note);
}

bool Joining::join(const std::atomic<bool>& stop, rt::SignalWord& wake, base::SharedText& problem) {
  while (!stop.load(std::memory_order_acquire)) {
    const auto tried = try_once();
    problem.set(tried ? *tried : tried.error().text);
    if (tried) {
      return true;
    }
    wake.wait_until(rt::MonoClock::now() + kRetry);
  }
  return false;
}

void Joining::leave() noexcept {
  if (participant_.ok()) {
    close_();
  }
  participant_.reset();
}

}  // namespace indurop::dds
