// SPDX-License-Identifier: Apache-2.0
// Starts the pulses of a slave's clock (SYNC0, SYNC1) before it goes to SAFEOP: waits until the clock is in step with
// the reference, then writes cycle and first pulse. In OP it asks the slave from time to time when its next pulse is.
// One datagram each time it is asked. Real-time safe.

#pragma once

#include <array>
#include <optional>

#include "control/io/ethercat/master/clocks.h"
#include "control/io/ethercat/master/plan.h"

namespace indurop::io::ethercat {

class SyncSetup {
 public:
  enum class Outcome { Running, Done, NoClock, NotInStep };

  // Both are borrowed until the end.
  SyncSetup(const SyncPlan& plan, std::size_t place, Clocks& clocks) : plan_(plan), clocks_(clocks), place_(place) {}

  // The slave begins from nothing: its clock has to be set, whether it has pulses or not.
  void slave_found(Clock now) noexcept { clocks_.found(place_, now); }
  void start(Clock now) noexcept;
  // Nothing: it waits for the clock.
  std::optional<Query> query(Clock now) noexcept;
  Outcome answer(bool is_answered) noexcept;
  // What came of waiting for the clock.
  [[nodiscard]] Outcome outcome(Clock now) const noexcept;

  // Whether it is time to ask for the next pulse of the slave, and how long after the frame of a tick that is, by the
  // clocks of slave and reference; nothing until it was asked.
  [[nodiscard]] bool wants_pulse(Clock now) const noexcept { return plan_.activation != 0 && now >= ask_pulse_at_; }
  Query pulse_query(Clock now) noexcept;
  void take_pulse(Bytes data) noexcept;
  [[nodiscard]] std::optional<Clock> pulse_after() const noexcept { return pulse_after_; }
  // How far its clock was ahead of the reference's, ns.
  [[nodiscard]] std::int32_t difference_ns() const noexcept { return clocks_.difference_ns(place_); }

 private:
  enum class Step { Await, Off, Cycles, Start, On };  // in this order

  const SyncPlan& plan_;
  Clocks& clocks_;
  std::size_t place_;
  Step step_ = Step::Await;
  Clock since_{0};
  Clock ask_pulse_at_{0};
  std::optional<Clock> pulse_after_;
  std::array<std::uint8_t, 8> word_{};  // that a query writes
};

}  // namespace indurop::io::ethercat
