// SPDX-License-Identifier: Apache-2.0
// The simulated network between the boards of a plant.

#pragma once

#include <chrono>
#include <cstdint>

namespace indurop::config {

struct SimulatedNetwork {
  std::chrono::nanoseconds delay{std::chrono::microseconds(100)};  // minimum delay of a message
  std::chrono::nanoseconds jitter{};                               // maximum random additional delay
  std::chrono::nanoseconds repeat{std::chrono::milliseconds(5)};   // a lost message is sent again after this time
  double loss = 0;                                                 // share of messages lost at random
  std::int64_t seed = 1;                                           // of the random numbers

  static constexpr std::chrono::nanoseconds kLeastDelay{std::chrono::microseconds(1)};
  static constexpr std::chrono::nanoseconds kLongest{std::chrono::seconds(10)};
  static constexpr double kMaxLoss = 0.9;
};

}  // namespace indurop::config
