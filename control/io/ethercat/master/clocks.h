// SPDX-License-Identifier: Apache-2.0
// The distributed clocks of a bus: measures how long frames take to each slave, sets all clocks to that of the first
// slave that has one, watches that they follow it, and tells the tick how to follow it, too. One datagram on the way at
// most; never waits. Slaves are addressed by their positions on the cable, so those that the configuration does not
// know are measured as well. Real-time safe after construction.

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "control/io/ethercat/master/phase_lock.h"
#include "control/io/ethercat/master/propagation.h"
#include "control/io/ethercat/master/query.h"

namespace indurop::io::ethercat {

class Clocks {
 public:
  // `period`: of the tick. `slaves`: in the configuration; zero: nothing uses clocks, and nothing is sent.
  Clocks(std::size_t slaves, Clock period);

  // A slave was found or lost: clocks are measured again, and that of a slave that was found is set again.
  void found(std::size_t place, Clock now) noexcept;
  void count(std::size_t slaves_on_cable, Clock now) noexcept;

  std::optional<Query> query(Clock now) noexcept;
  void answer(Bytes data, bool is_answered, Clock now) noexcept;
  void lost(Clock now) noexcept;

  // The position of the slave whose clock all others follow; nothing until clocks are set.
  [[nodiscard]] std::optional<std::size_t> reference() const noexcept;
  // Its time, as far as the master knows it, ns.
  [[nodiscard]] std::int64_t reference_time(Clock now) const noexcept;
  // The frame that was sent at `sent` passed the reference at this time of it.
  void passed(std::int64_t reference_ns, Clock sent, Clock now) noexcept;
  // How long after the frame of the last tick the clock of this slave shows this time, ns.
  [[nodiscard]] std::int64_t since_passed(std::size_t place, std::int64_t shown) const noexcept;
  // The frame of a tick did not come back.
  void not_passed() noexcept;

  [[nodiscard]] bool has_clock(std::size_t place) const noexcept { return ports_[place].has_clock; }
  [[nodiscard]] bool is_measured() const noexcept { return step_ == Step::Watch; }
  // Its clock was set, and shows the reference's time within a microsecond.
  [[nodiscard]] bool is_in_step(std::size_t place) const noexcept;
  // How far its clock was ahead of the reference's when it was asked last, ns.
  [[nodiscard]] std::int32_t difference_ns(std::size_t place) const noexcept { return slaves_[place].difference; }
  [[nodiscard]] std::uint32_t delay_ns(std::size_t place) const noexcept { return delays_[place]; }
  // A clock that was in step and is no longer, with how far it is ahead of the reference, ns; it is being set again.
  // Reported once.
  struct Lost {
    std::size_t place = 0;
    std::int32_t ahead_ns = 0;
  };
  std::optional<Lost> take_lost() noexcept { return std::exchange(lost_, std::nullopt); }
  // The open ports of the slaves do not make a tree, so no delay is known.
  [[nodiscard]] bool is_tree_unclear() const noexcept { return is_tree_unclear_; }
  // The next time of the reference at which a pulse with this cycle and shift is due, at least this far ahead.
  [[nodiscard]] std::int64_t next_pulse(Clock cycle, Clock shift, Clock ahead, Clock now) const noexcept;
  // By how much the next period of the tick has to be longer, ns.
  [[nodiscard]] std::int64_t tick_correction() const noexcept { return correction_; }
  // How late the last frame passed the reference, ns.
  [[nodiscard]] std::int64_t phase_ns() const noexcept { return lock_.phase_ns(); }

 private:
  enum class Step { Wait, Features, Unit, Latch, Times, Ports, Offset, Delay, Filter, Watch };  // in this order
  struct Slave {
    std::int64_t received = 0;  // the frame that was latched, by its own clock
    std::int64_t offset = 0;    // of the reference's time to its own clock
    bool is_long = true;        // its clock has 64 bits, else 32
    bool is_set = false;
    std::int32_t difference = 0;
    unsigned close_reads = 0;  // of the difference, one after another
    bool was_in_step = false;  // since its clock was set
  };

  void restart(Clock now) noexcept;
  [[nodiscard]] bool concerns(std::size_t place) const noexcept;
  bool find_next() noexcept;
  void advance(Clock now) noexcept;
  void finish_step(Clock now) noexcept;
  void take(Bytes data) noexcept;
  [[nodiscard]] std::int64_t whole(std::int64_t reference_ns, Clock sent) const noexcept;
  bool work_out() noexcept;

  std::vector<Slave> slaves_;
  std::vector<PortTimes> ports_;
  std::vector<std::uint32_t> delays_;
  Propagation propagation_;
  PhaseLock lock_;
  std::size_t on_cable_ = 0;
  Step step_ = Step::Wait;
  std::size_t place_ = 0;
  Clock begin_at_{0};
  Clock latched_at_{0};                 // receive times, by the master
  std::array<std::uint8_t, 8> word_{};  // that a query writes
  std::optional<std::size_t> reference_;
  std::int64_t passed_ns_ = 0;  // by the reference
  Clock passed_at_{0};          // by the master
  std::optional<Lost> lost_;
  bool is_tree_unclear_ = false;
  std::int64_t correction_ = 0;
};

}  // namespace indurop::io::ethercat
