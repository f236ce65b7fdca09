// SPDX-License-Identifier: Apache-2.0
// Copies bits from the inputs of slaves to the outputs of others, without knowing what they are (slave-to-slave copy
// of ETG.1500): what safety devices send each other, for example. It has no safety function of its own.

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "control/io/ethercat/master/events.h"

namespace indurop::io::ethercat {

class Master;

struct Copy {
  std::size_t from = 0;      // place of the slave on the cable
  std::size_t from_bit = 0;  // in its inputs
  std::size_t to = 0;
  std::size_t to_bit = 0;  // in the outputs of that slave
  std::size_t bits = 0;
  Clock hold{0};  // how long the target keeps the last bits after the source has no valid ones
};

class Copies {
 public:
  Copies() = default;
  // What the outputs of the targets have now are their fail-safe values: they have them before the first valid bits,
  // and when the last ones were held long enough.
  Copies(const std::vector<Copy>& copies, Master& master);

  // Between receive() and send() of the master: what came with the last cycle leaves with the next one. Real-time safe.
  void run(Master& master, Clock now) noexcept;
  // Each change between valid bits and fail-safe values. Real-time safe.
  bool next_event(Event& event) noexcept { return events_.pop(event); }

 private:
  struct Running {
    Copy copy;
    std::vector<std::uint8_t> fail_safe;  // from its first bit on
    std::optional<Clock> valid_at;        // nothing: the target has its fail-safe value
  };
  void report(const Copy& copy, Problem problem, Clock now) noexcept;

  std::vector<Running> copies_;
  Events events_;
};

}  // namespace indurop::io::ethercat
