// SPDX-License-Identifier: Apache-2.0
#include "node/simulate/simulation.h"

#include <algorithm>
#include <csignal>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/processor_time.h"

namespace indurop::node {
namespace {

// The conductor of a plant sends the place first of all.
BoardPlace receive_place(std::optional<BoardChannel>& conductor) {
  BoardPlace place;
  place.begin_ns = rt::to_ns(Simulation::kBegin);
  if (conductor) {
    while (conductor->receive(place) == BoardChannel::Got::Nothing) {
    }
  }
  return place;
}

}  // namespace

Simulation::Simulation(const config::Simulation& settings, vars::Store& store, scheduler::RunBlock& run,
                       base::StopSignal& signals, scheduler::ProcessWatch watch)
    : settings_(settings),
      run_(run),
      signals_(signals),
      conductor_(settings.conductor ? std::optional<BoardChannel>(*settings.conductor) : std::nullopt),
      place_(receive_place(conductor_)),
      kernel_(rt::mono_time(place_.begin_ns), {&store.virtual_time(), &run.virtual_ns}, std::move(watch)),
      began_(rt::MonoClock::now()) {}

int Simulation::pass(std::chrono::nanoseconds duration) {
  if (conductor_) {
    return follow(duration);
  }
  if (settings_.step) {
    return step();
  }
  go_to(kernel_.now() + duration);
  return keep_pace();
}

// Stops at the times that processes request.
void Simulation::go_to(rt::MonoTime until) {
  for (rt::MonoTime next = attend_(); next < until && !ended_(); next = attend_()) {
    kernel_.sleep_until(std::max(next, kernel_.now()));
  }
  kernel_.sleep_until(until);
}

// Advances as far as the plant, until `duration` of time has passed.
int Simulation::follow(std::chrono::nanoseconds duration) {
  const rt::MonoTime end = kernel_.now() + duration;
  if (!std::exchange(ready_reported_, true)) {
    kernel_.sleep_until(kernel_.now());
    (void)answer();
  }
  BoardOrder order;
  while (kernel_.now() < end && !ended_()) {
    const BoardChannel::Got got = conductor_->receive(order);
    if (got == BoardChannel::Got::Nothing) {
      if (const int number = signals_.wait(std::chrono::nanoseconds{0}); number != 0) {
        return number;
      }
      continue;
    }
    if (got == BoardChannel::Got::End || order.end) {
      left_ = got == BoardChannel::Got::Word && order.signal == 0;
      return left_ ? 0 : got == BoardChannel::Got::End ? SIGTERM : order.signal;
    }
    for (const mirror::Message& message : order.arrivals) {
      kernel_.sleep_until(rt::mono_time(message.time_ns));
      link_.arrived(message);
      kernel_.sleep_until(kernel_.now());  // runs the threads it woke
    }
    go_to(rt::mono_time(order.until_ns));
    if (!answer()) {
      return SIGTERM;
    }
  }
  return signals_.wait(std::chrono::nanoseconds{0});
}

// Returns false if the other end is closed.
bool Simulation::answer() {
  BoardAnswer answer;
  answer.now_ns = rt::to_ns(kernel_.now());
  answer.next_ns = rt::to_ns(kernel_.next_event());
  answer.epoch_ns = run_.epoch_ns;
  answer.basic_period_ns = run_.basic_period_ns;
  const std::int64_t busy = rt::thread_time_ns();
  answer.took_ns = busy - std::exchange(busy_ns_, busy);
  answer.ended = ended_();
  answer.sent = link_.take_sent();
  return conductor_->send(answer);
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

// The node is paused after a tick: all work of it is done, the next has not begun.
int Simulation::step() {
  if (!stands_at_) {
    stands_at_ = rt::mono_time(run_.epoch_ns) + std::chrono::nanoseconds(-1);
    kernel_.sleep_until(*stands_at_);
    print_position(run_.tick.load(), run_.basic_period_ns);
  }
  const StepInput::Order order = input_.next(signals_, run_.basic_period_ns);
  left_ = order.end;
  if (order.end || order.signal != 0) {
    return order.signal;
  }
  *stands_at_ += std::chrono::nanoseconds(order.ticks * run_.basic_period_ns);
  go_to(*stands_at_);
  print_position(run_.tick.load(), run_.basic_period_ns);
  return signals_.wait(std::chrono::nanoseconds{0});
}

}  // namespace indurop::node
