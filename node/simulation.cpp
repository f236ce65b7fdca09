// SPDX-License-Identifier: Apache-2.0
#include "node/simulation.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "base/duration.h"
#include "rt/clock.h"

namespace indurop::node {
namespace {

// Every run begins at the same time, and none at 0, which means real time.
constexpr rt::MonoTime kBegin = rt::mono_time(rt::kNanosPerSecond);
constexpr std::chrono::milliseconds kLook{20};  // for a stop signal, while standard input is waited for

}  // namespace

Simulation::Simulation(const config::Simulation& settings, vars::Store& store, scheduler::RunBlock& run,
                       base::StopSignal& signals, scheduler::ProcessWatch watch)
    : settings_(settings),
      run_(run),
      signals_(signals),
      kernel_(kBegin, {&store.virtual_time(), &run.virtual_ns}, std::move(watch)),
      began_(rt::MonoClock::now()) {}

int Simulation::pass(std::chrono::nanoseconds look) {
  if (settings_.step) {
    return step();
  }
  kernel_.sleep_until(kernel_.now() + look);
  return keep_pace();
}

int Simulation::keep_pace() {
  if (settings_.speed == 0) {
    return signals_.wait(std::chrono::nanoseconds{0});
  }
  const auto virtual_passed = static_cast<double>((kernel_.now() - kBegin).count());
  const rt::MonoTime due =
      began_ + std::chrono::nanoseconds(static_cast<std::int64_t>(virtual_passed / settings_.speed));
  const rt::MonoTime now = rt::MonoClock::now();
  return signals_.wait(due > now ? due - now : std::chrono::nanoseconds{0});
}

// The node stands behind a tick: all that belongs to it is done, the next has not begun.
int Simulation::step() {
  if (stands_at_ == rt::MonoTime{}) {
    stands_at_ = rt::mono_time(run_.epoch_ns) + std::chrono::nanoseconds(-1);
    kernel_.sleep_until(stands_at_);
    tell_place();
  }
  for (;;) {
    if (const auto end = input_.find('\n'); end != std::string::npos) {
      const std::string line = input_.substr(0, end);
      input_.erase(0, end + 1);
      left_ = !obey(line);
      return signals_.wait(std::chrono::nanoseconds{0});
    }
    if (const int number = signals_.wait(std::chrono::nanoseconds{0}); number != 0) {
      return number;
    }
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, static_cast<int>(kLook.count())) <= 0) {
      continue;
    }
    char text[256];
    const ssize_t count = ::read(STDIN_FILENO, text, sizeof text);
    if (count <= 0) {
      left_ = true;
      return 0;
    }
    input_.append(text, static_cast<std::size_t>(count));
  }
}

// False: it is to end.
bool Simulation::obey(const std::string& line) {
  if (line == "q" || line == "quit") {
    return false;
  }
  std::int64_t ticks = 1;
  if (!line.empty()) {
    const base::DurationText read = base::read_duration(line, false, base::PlainNumber::Nanoseconds);
    const bool is_count = line.find_first_not_of("0123456789") == std::string::npos;
    if (!read.value || read.value->count() <= 0) {
      fmt::print(stderr,
                 "'{}' is not understood: Enter goes on by one tick, 10 by ten, 20ms by a time, q ends the run\n",
                 line);
      return true;
    }
    ticks = is_count ? read.value->count() : (read.value->count() + run_.basic_period_ns - 1) / run_.basic_period_ns;
  }
  stands_at_ += std::chrono::nanoseconds(ticks * run_.basic_period_ns);
  kernel_.sleep_until(stands_at_);
  tell_place();
  return true;
}

void Simulation::tell_place() {
  const std::uint64_t tick = run_.tick.load();
  fmt::print("tick {}, {}\n", tick,
             base::format_duration(base::Nanos(static_cast<std::int64_t>(tick) * run_.basic_period_ns)));
  std::fflush(stdout);
}

}  // namespace indurop::node
