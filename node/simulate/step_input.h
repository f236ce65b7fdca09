// SPDX-License-Identifier: Apache-2.0
// Standard input of --step: how far a paused simulation advances.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/stop_signal.h"

namespace indurop::node {

class StepInput {
 public:
  struct Order {
    std::int64_t ticks = 0;  // number of ticks to advance
    bool end = false;        // the user requested the end, or the input has ended
    int signal = 0;          // signal received instead of a line
  };
  // Waits for a valid line. `basic_period_ns`: length of a tick.
  Order next(base::StopSignal& signals, std::int64_t basic_period_ns);

 private:
  static std::optional<Order> understand(const std::string& line, std::int64_t basic_period_ns);
  bool read_more();

  std::string input_;
};

// Prints where the simulation is now.
void print_position(std::uint64_t tick, std::int64_t basic_period_ns);

}  // namespace indurop::node
