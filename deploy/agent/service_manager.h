// SPDX-License-Identifier: Apache-2.0
// What systemd is told: that the agent is ready, and that it still lives (sd_notify(3), WatchdogSec= of its unit).

#pragma once

#include <chrono>
#include <string>

#include "rt/clock.h"

namespace indurop::deploy {

class ServiceManager {
 public:
  // By $NOTIFY_SOCKET and $WATCHDOG_USEC; does nothing if nobody listens.
  ServiceManager();
  void ready() const { tell("READY=1"); }
  void stopping() const { tell("STOPPING=1"); }
  // Says that all is well, often enough.
  void alive(rt::MonoTime now);

 private:
  void tell(const std::string& state) const;
  std::string socket_;
  std::chrono::nanoseconds every_{};  // 0: nobody waits for it
  rt::MonoTime told_{};
};

}  // namespace indurop::deploy
