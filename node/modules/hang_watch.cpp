// SPDX-License-Identifier: Apache-2.0
#include "node/modules/hang_watch.h"

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "core/rt/clock.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kHangPoll{50};
constexpr std::chrono::seconds kTimeoutAtEnd{2};

// A signal that every thread blocks stays pending for the main thread, which is inside a module.
bool end_is_wanted() {
  sigset_t pending;
  ::sigemptyset(&pending);
  ::sigpending(&pending);
  return ::sigismember(&pending, SIGINT) == 1 || ::sigismember(&pending, SIGTERM) == 1 ||
         ::sigismember(&pending, SIGHUP) == 1;
}

// A program paused by `indurop plc debug` does not hang.
bool is_debugged() {
  return std::getenv("INDUROP_PLC_DEBUG") != nullptr;  // NOLINT(concurrency-mt-unsafe): no code sets it
}

}  // namespace

HangWatch::HangWatch(std::function<std::uint64_t()> progress, std::function<void()> end)
    : progress_(std::move(progress)), end_(std::move(end)) {
  auto thread = rt::Thread::start({"irp-sim-watch", 0, -1}, [this] { loop(); });
  if (thread) {
    thread_ = std::move(thread).value();
  }
}

HangWatch::~HangWatch() {
  stop_.store(true);
  thread_.join();
}

void HangWatch::loop() {
  const bool debugged = is_debugged();
  std::uint64_t before = progress_();
  rt::MonoTime since = rt::MonoClock::now();
  while (!stop_.load()) {
    rt::sleep_until(rt::MonoClock::now() + kHangPoll);
    const std::uint64_t now = progress_();
    if (now != before) {
      before = now;
      since = rt::MonoClock::now();
    } else if (const bool ends = end_is_wanted();
               (ends || !debugged) && rt::MonoClock::now() - since > (ends ? kTimeoutAtEnd : kTimeout)) {
      end_();
    }
  }
}

}  // namespace indurop::node
