// SPDX-License-Identifier: Apache-2.0
#include "tools/client/process/interrupt.h"

#include <poll.h>
#include <csignal>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <ctime>

#include "core/rt/clock.h"

namespace indurop::tools {
namespace {

// A handler needs a global; it is the only one of this program.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler is given nothing else
std::atomic<int> caught_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int number) {
  caught_signal.store(number, std::memory_order_relaxed);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = &on_signal;
  sigemptyset(&action.sa_mask);
  // Several signals may come at once, one for each thread of a parent that is killed.
  sigaction(SIGTERM, &action, nullptr);
  // After the first one the default is restored: a second Ctrl-C always ends the program.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, nullptr);
  sigaction(SIGXFSZ, &ignore, nullptr);  // a write beyond the file size limit then fails, and the failure is reported
}

EndsAtOnce::EndsAtOnce() noexcept {
  const int caught = caught_signal.load(std::memory_order_relaxed);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (caught != 0) {
    std::raise(caught);  // it came earlier
  }
}

EndsAtOnce::~EndsAtOnce() {
  catch_interrupts();
}

bool interrupted() noexcept {
  return caught_signal.load(std::memory_order_relaxed) != 0;
}

int interrupt_code() noexcept {
  return 128 + caught_signal.load(std::memory_order_relaxed);
}

void take_interrupt() noexcept {
  caught_signal.store(0, std::memory_order_relaxed);
}

Woken wait_until(std::int64_t deadline_ns, int fd) noexcept {
  // Signals are unblocked only inside ppoll, so one that comes between the test and the sleep is not lost.
  sigset_t ours;
  sigset_t before;
  sigemptyset(&ours);
  sigaddset(&ours, SIGINT);
  sigaddset(&ours, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ours, &before);
  Woken why = Woken::Deadline;
  if (interrupted()) {
    why = Woken::Signal;
  } else {
    const timespec left = rt::to_timespec(std::max<std::int64_t>(0, deadline_ns - rt::now_ns()));
    pollfd file{fd, POLLIN, 0};
    const int n = ppoll(&file, fd >= 0 ? 1 : 0, &left, &before);
    why = n > 0 ? Woken::Readable : n < 0 ? Woken::Signal : Woken::Deadline;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return why;
}

}  // namespace indurop::tools
