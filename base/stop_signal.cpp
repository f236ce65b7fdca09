// SPDX-License-Identifier: Apache-2.0
#include "base/stop_signal.h"

#include <pthread.h>

#include <initializer_list>

#include "rt/clock.h"

namespace indurop::base {

StopSignal::StopSignal() noexcept {
  ::sigemptyset(&set_);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) {
    ::sigaddset(&set_, number);
  }
  ::pthread_sigmask(SIG_BLOCK, &set_, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a closed terminal or pipe must not end a running robot
}

int StopSignal::wait(std::int64_t timeout_ns) noexcept {
  const timespec timeout = rt::to_timespec(timeout_ns);
  const int number = ::sigtimedwait(&set_, nullptr, &timeout);
  if (number > 0 && number != SIGCHLD) {
    received_ = number;
  }
  return received_;
}

}  // namespace indurop::base
