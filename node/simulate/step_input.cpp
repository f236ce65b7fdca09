// SPDX-License-Identifier: Apache-2.0
#include "node/simulate/step_input.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "core/base/duration.h"
#include "core/base/print.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kInputPoll{20};  // for a stop signal, while waiting for standard input

}  // namespace

StepInput::Order StepInput::next(base::StopSignal& signals, std::int64_t basic_period_ns) {
  for (;;) {
    if (const auto end = input_.find('\n'); end != std::string::npos) {
      const std::string line = input_.substr(0, end);
      input_.erase(0, end + 1);
      if (const auto order = understand(line, basic_period_ns)) {
        return *order;
      }
      continue;
    }
    if (const int number = signals.wait(std::chrono::nanoseconds{0}); number != 0) {
      return {0, false, number};
    }
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, static_cast<int>(kInputPoll.count())) > 0 && !read_more()) {
      return {0, true, 0};
    }
  }
}

bool StepInput::read_more() {
  char text[256];
  const ssize_t count = ::read(STDIN_FILENO, text, sizeof text);
  input_.append(text, count > 0 ? static_cast<std::size_t>(count) : 0);
  return count > 0;
}

std::optional<StepInput::Order> StepInput::understand(const std::string& line, std::int64_t basic_period_ns) {
  if (line == "q" || line == "quit") {
    return Order{0, true, 0};
  }
  if (line.empty()) {
    return Order{1, false, 0};
  }
  const base::DurationText read = base::read_duration(line, false, base::PlainNumber::Nanoseconds);
  const bool is_count = line.find_first_not_of("0123456789") == std::string::npos;
  if (!read.value || read.value->count() <= 0) {
    base::print(stderr, "'{}' is not understood: Enter runs one tick, 10 runs ten, 20ms by a time, q ends the run\n",
                line);
    return std::nullopt;
  }
  return Order{is_count ? read.value->count() : (read.value->count() + basic_period_ns - 1) / basic_period_ns, false,
               0};
}

void print_position(std::uint64_t tick, std::int64_t basic_period_ns) {
  base::print(stdout, "tick {}, {}\n", tick,
              base::format_duration(base::Nanos(static_cast<std::int64_t>(tick) * basic_period_ns)));
  std::fflush(stdout);
}

}  // namespace indurop::node
