// SPDX-License-Identifier: Apache-2.0
// How long a frame takes from the first slave of a bus to each other one, from the times at which one frame passed the
// ports of all of them.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "control/io/ethercat/registers.h"

namespace indurop::io::ethercat {

struct PortTimes {
  bool has_clock = false;  // without one there are no times
  // When the frame arrived at each port, in ns of the slave's own clock, which wraps around. A frame comes in at port 0
  // and visits what is linked at the ports 3, 1 and 2, in this order.
  std::array<std::uint32_t, kPorts> arrival{};
  std::array<bool, kPorts> is_open{};  // a slave, or the master, is linked there
};

class Propagation {
 public:
  explicit Propagation(std::size_t slaves);

  // `slaves` in the order in which a frame passes them, at most as many as the constructor was given; `delays`, of the
  // same size, gets the time from the processing unit of the first slave with a clock to that of each other one, in
  // ns. Cables are assumed to take equally long in both directions; slaves without a clock count as cable. Returns
  // false, and leaves `delays` undefined, if the open ports are not those of a tree that is entered at port 0, or if it
  // branches at a slave without a clock. Real-time safe.
  bool find(std::span<const PortTimes> slaves, std::span<std::uint32_t> delays) noexcept;

 private:
  // The way from the last slave with a clock to here; without one before it takes no time.
  struct Way {
    std::uint32_t begin = 0;  // when the frame leaves that slave, as a delay of the first one
    std::uint32_t away = 0;   // how long it is away from that slave
    bool is_timed = false;
  };
  struct Visit {
    std::size_t slave = 0;
    Way way;
    std::size_t port = 0;  // at which the frame arrived last, as a place in the order of ports
  };
  static std::uint32_t delay_at_end(const Way& way, const PortTimes& slave) noexcept;

  std::vector<Visit> path_;  // from the first slave to where the frame is
};

}  // namespace indurop::io::ethercat
