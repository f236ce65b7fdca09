// SPDX-License-Identifier: Apache-2.0
#include "core/base/stop_signal.h"

#include <pthread.h>

#include <initializer_list>

#include "core/rt/clock.h"

namespace indurop::base {

bool is_ignored(int number) noexcept {
  struct sigaction now {};
  return ::sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

StopSignal::StopSignal() noexcept {
  ::sigemptyset(&set_);
  for (const int number : {SIGINT, SIGTERM, SIGCHLD}) {
    ::sigaddset(&set_, number);
  }
  if (!is_ignored(SIGHUP)) {  // as nohup(1) has it; a blocked signal would come although it is ignored
    ::sigaddset(&set_, SIGHUP);
  }
  ::pthread_sigmask(SIG_BLOCK, &set_, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a closed terminal or pipe must not end a running robot
  std::signal(SIGXFSZ, SIG_IGN);  // nor a limit of file sizes: the write fails, and that is reported
}

int StopSignal::wait(std::chrono::nanoseconds timeout) noexcept {
  const timespec most = rt::to_timespec(timeout.count());
  const int number = ::sigtimedwait(&set_, nullptr, &most);
  if (number > 0 && number != SIGCHLD) {
    received_ = number;
  }
  return received_;
}

}  // namespace indurop::base
