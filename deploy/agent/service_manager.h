// SPDX-License-Identifier: Apache-2.0
// Reports to systemd that the agent is ready, and that it is alive (sd_notify(3), WatchdogSec= of its unit).

#pragma once

#include <chrono>
#include <string>

#include "core/rt/clock.h"

namespace indurop::deploy {

class ServiceManager {
 public:
  // Uses $NOTIFY_SOCKET and $WATCHDOG_USEC; does nothing if they are not set.
  ServiceManager();
  void ready() const { notify("READY=1"); }
  void stopping() const { notify("STOPPING=1"); }
  // Reports that all is well, often enough for the watchdog.
  void alive(rt::MonoTime now);

 private:
  void notify(const std::string& state) const;
  std::string socket_;
  std::chrono::nanoseconds every_{};  // 0: no watchdog
  rt::MonoTime notified_{};
};

}  // namespace indurop::deploy
