// SPDX-License-Identifier: Apache-2.0
// Slaves on one cable, in a line. A frame passes all of them that have power up to the first that has none, and comes
// back.

#pragma once

#include <cstdint>
#include <deque>
#include <optional>

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
  // How many slaves a frame reaches now.
  [[nodiscard]] std::size_t reached() const noexcept;

  // Passes a frame that leaves the master now. Returns when it is back; nothing if no slave turns it round.
  std::optional<Time> process(std::span<std::uint8_t> frame, Time now);
  // Runs the applications of slaves that the frame has passed.
  void compute();
  // A frame is broken on its way to this slave: it counts an error at its port, and all drop the frame.
  void break_frame_at(std::size_t index) noexcept;

 private:
  void link() noexcept;

  Time delay_;  // of one cable and one slave
  std::deque<Slave> slaves_;
};

}  // namespace indurop::io::ethercat
