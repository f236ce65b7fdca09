// SPDX-License-Identifier: Apache-2.0
// Standard input of --step: how far a simulation that stands is to go.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/stop_signal.h"

namespace indurop::node {

class StepInput {
 public:
  struct Order {
    std::int64_t ticks = 0;  // to go on by
    bool end = false;        // somebody does not want to go on, or nobody can say so any more
    int signal = 0;          // came instead
  };
  // Waits for a line that is understood. `basic_period_ns`: of the ticks.
  Order next(base::StopSignal& signals, std::int64_t basic_period_ns);

 private:
  static std::optional<Order> understand(const std::string& line, std::int64_t basic_period_ns);
  bool read_more();

  std::string input_;
};

// Says where the simulation stands now.
void tell_place(std::uint64_t tick, std::int64_t basic_period_ns);

}  // namespace indurop::node
