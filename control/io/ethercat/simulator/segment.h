// SPDX-License-Identifier: Apache-2.0
// Slaves on one cable: in a line, in a tree, or in a ring. A frame passes all slaves that have power and are linked to
// the master through slaves that have it, and comes back; on a ring that is whole it comes out at the other end.

#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "control/io/ethercat/simulator/slave.h"

namespace indurop::io::ethercat {

class Segment {
 public:
  explicit Segment(Time delay = Time(500)) : delay_(delay) {}

  // A port of a slave that leads to another slave. A frame leaves a slave through its ports 3, 1 and 2, in this order.
  struct Outlet {
    std::size_t slave = 0;
    std::size_t port = 1;
  };
  // Whether the next slave can be there: its port is free, and a frame comes to it after all slaves that were added. A
  // ring has no branches.
  [[nodiscard]] bool can_add(Outlet outlet) const noexcept;
  // Behind port 1 of the slave that was added last, or at an outlet that can_add() accepts.
  Slave& add(SlaveConfig config, Slave::Application application = {});
  Slave& add(SlaveConfig config, Slave::Application application, Outlet outlet);
  [[nodiscard]] std::size_t size() const noexcept { return slaves_.size(); }
  [[nodiscard]] Slave& slave(std::size_t index) noexcept { return slaves_[index]; }

  // Cuts the power of a slave, and with it the cables to those behind it.
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
  static constexpr std::size_t kNone = SIZE_MAX;
  // Where a slave is on the cable.
  struct Node {
    std::size_t parent = kNone;                                          // none: the master
    std::size_t port = 1;                                                // of the parent
    std::array<std::size_t, kPorts> behind{kNone, kNone, kNone, kNone};  // the slave at each port
    std::size_t reached = 0;                                             // slaves that a frame passes at and behind it
  };

  Slave& add_at(SlaveConfig config, Slave::Application application, std::size_t parent, std::size_t port);
  void link() noexcept;
  // Whether a frame leaves through this port to a slave.
  [[nodiscard]] bool leads_on(const Node& node, std::size_t port) const noexcept {
    return node.behind[port] != kNone && is_linked(node.behind[port]);
  }
  // Whether there is a way through the cable before this slave.
  [[nodiscard]] bool is_linked(std::size_t before) const noexcept;
  // Through all slaves at and behind this one, and back to its port 0.
  void pass_branch(std::span<std::uint8_t> frame, Time now, std::size_t slave);
  [[nodiscard]] Time pass_line(std::span<std::uint8_t> frame, Time now, std::size_t begin);

  Time delay_;  // of one cable and one slave
  std::deque<Slave> slaves_;
  std::vector<Node> nodes_;
  bool is_ring_ = false;
  std::vector<bool> is_cut_ = {false};  // the cable before each slave, and that behind the last one
};

}  // namespace indurop::io::ethercat
