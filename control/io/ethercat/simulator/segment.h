// SPDX-License-Identifier: Apache-2.0
// Slaves on one cable, in a line or in a ring. A frame passes all of them that have power up to the first that has
// none, and comes back; on a ring that is whole it comes out at the other end.

#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "control/io/ethercat/simulator/slave.h"

namespace indurop::io::ethercat {

class Segment {
 public:
  explicit Segment(Time delay = Time(500)) : delay_(delay) {}

  Slave& add(SlaveConfig config, Slave::Application application = {});
  [[nodiscard]] std::size_t size() const noexcept { return slaves_.size(); }
  [[nodiscard]] Slave& slave(std::size_t index) noexcept { return slaves_[index]; }

  // Cuts the power of a slave, and with it the cable to those after it.
  void set_power(std::size_t index, bool on);
  // The cable after the last slave leads back to the master.
  void make_ring();
  // Cuts or heals the cable before this slave, or behind the last one.
  void set_cable(std::size_t before, bool whole);

  enum class End : std::uint8_t { First, Last };
  struct Passed {
    Time back{0};  // when it is at the master again
    End at = End::First;
  };
  // Passes a frame that leaves the master now at this end; nothing if it does not come back. Slaves work on it when it
  // passes them from the first to the last one.
  std::optional<Passed> pass(std::span<std::uint8_t> frame, Time now, End from);
  // The same at the first end, where it has to come back.
  std::optional<Time> process(std::span<std::uint8_t> frame, Time now);
  // Runs the applications of slaves that the frame has passed.
  void compute();
  // A frame is broken on its way to this slave: it counts an error at its port, and all drop the frame.
  void break_frame_at(std::size_t index) noexcept;

 private:
  void link() noexcept;
  // Whether there is a way through the cable before this slave.
  [[nodiscard]] bool is_linked(std::size_t before) const noexcept;
  [[nodiscard]] Time pass_slaves(std::span<std::uint8_t> frame, Time now, std::size_t begin, std::size_t end,
                                 bool turns_round);

  Time delay_;  // of one cable and one slave
  std::deque<Slave> slaves_;
  bool is_ring_ = false;
  std::vector<bool> is_cut_ = {false};  // the cable before each slave, and that behind the last one
};

}  // namespace indurop::io::ethercat
