// SPDX-License-Identifier: Apache-2.0
#include "tools/iceoryx/supervisor.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "core/base/spawn.h"
#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"
#include "tools/iceoryx/publisher.h"
#include "tools/iceoryx/roudi.h"

namespace indurop::iceoryx {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kLookEvery = kSecond / 10;
constexpr std::int64_t kPauseAfterDeath = kSecond;
// After this many processes in a row that iceoryx ended soon after their start, it gives up.
constexpr int kHopeless = 3;
constexpr std::int64_t kSoon = 5 * kSecond;

class Supervisor {
 public:
  Supervisor(tools::Context& context, tools::WatchSource& source, int hz)
      : context_(context), source_(source), hz_(hz) {}
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  ~Supervisor() { end_worker(); }

  int run() {
    while (!tools::interrupted()) {
      if (worker_ < 0) {
        start_if_roudi();
      } else {
        monitor_worker();
      }
      if (early_aborts_ >= kHopeless) {
        return abandon();
      }
      tools::wait_until(rt::now_ns() + kLookEvery);
    }
    return tools::interrupt_code();
  }

 private:
  void start_if_roudi() {
    if (rt::now_ns() < not_before_) {
      return;
    }
    const Roudi now = find_roudi();
    if (now.state == Roudi::State::There) {
      reported_ = Roudi::State::There;
      roudi_ = now;
      start_worker();
      return;
    }
    if (reported_ == now.state) {
      return;
    }
    reported_ = now.state;
    context_.out.note(now.state == Roudi::State::Absent
                          ? "RouDi does not run on this machine; waiting for it. Start it: iox-roudi"
                          : "RouDi belongs to another user (/tmp/roudi); waiting. Run both as one user");
  }

  void start_worker() {
    const pid_t parent = getpid();
    base::keep_ends_of_children();
    worker_ = fork();
    if (worker_ < 0) {
      context_.out.error(fmt::format("cannot start a process: {}; trying again", std::strerror(errno)));
      not_before_ = rt::now_ns() + kPauseAfterDeath;
      return;
    }
    if (worker_ > 0) {
      started_ns_ = rt::now_ns();
      return;
    }
    // Ends cleanly even without the parent: a killed publisher may leave a lock in RouDi's memory.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    std::exit(getppid() == parent ? publish(context_, source_, hz_) : kOk);
  }

  void monitor_worker() {
    int status = 0;
    if (waitpid(worker_, &status, WNOHANG) == worker_) {
      worker_ = -1;
      note_death(status);
      return;
    }
    if (find_roudi() == roudi_) {
      return;
    }
    // No other process uses its data any more, and there is no RouDi to unregister from.
    kill(worker_, SIGKILL);
    waitpid(worker_, nullptr, 0);
    worker_ = -1;
    early_aborts_ = 0;
    reported_ = Roudi::State::Absent;
    context_.out.note("RouDi has ended; waiting for it (programs that read have to be started again, too)");
  }

  void note_death(int status) {
    not_before_ = rt::now_ns() + kPauseAfterDeath;
    const bool aborted = WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
    const bool soon = rt::now_ns() - started_ns_ < kSoon;
    early_aborts_ = aborted && soon && find_roudi() == roudi_ ? early_aborts_ + 1 : 0;
    if (tools::interrupted()) {
      return;
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
      context_.out.error(fmt::format(
          "iceoryx did not answer for {} s, as happens after a program that uses it was killed; trying again. If that "
          "does not help, restart iox-roudi",
          kStuckSeconds));
    } else {
      context_.out.error(fmt::format("the publishing process ended ({}{}); starting it again",
                                     WIFSIGNALED(status) ? "signal " : "exit code ",
                                     WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)));
    }
  }

  int abandon() {
    const auto values = source_.values();
    const auto largest = std::max_element(values.begin(), values.end(),
                                          [](const auto& a, const auto& b) { return a.bytes.size() < b.bytes.size(); });
    context_.out.error(
        fmt::format("iceoryx ended the publishing process {} times in a row. Its message above says why; the largest "
                    "variable ({}, {} bytes) has to fit into a memory pool of RouDi, and there are publishers for {} "
                    "variables on the whole machine: select fewer with a GLOB",
                    kHopeless, largest->item.name, largest->bytes.size(), most_topics()));
    return kFailed;
  }

  void end_worker() {
    if (worker_ <= 0) {
      return;
    }
    kill(worker_, SIGTERM);
    // It ends itself if iceoryx hangs; the additional time is for a busy machine.
    const std::int64_t deadline = rt::now_ns() + (kStuckSeconds + 2) * kSecond;
    while (waitpid(worker_, nullptr, WNOHANG) == 0) {
      if (rt::now_ns() > deadline) {
        kill(worker_, SIGKILL);
        waitpid(worker_, nullptr, 0);
        break;
      }
      usleep(10'000);
    }
    worker_ = -1;
  }

  tools::Context& context_;
  tools::WatchSource& source_;
  int hz_;
  pid_t worker_ = -1;
  Roudi roudi_;  // the one that the worker uses
  Roudi::State reported_ = Roudi::State::There;
  std::int64_t started_ns_ = 0;
  std::int64_t not_before_ = 0;
  int early_aborts_ = 0;
};

}  // namespace

int supervise(tools::Context& context, tools::WatchSource& source, int hz) {
  return Supervisor(context, source, hz).run();
}

}  // namespace indurop::iceoryx
