// SPDX-License-Identifier: Apache-2.0
// The network between the boards of a plant while it is simulated.

#pragma once

#include <chrono>
#include <cstdint>

namespace indurop::config {

struct SimulatedNetwork {
  std::chrono::nanoseconds delay{std::chrono::microseconds(100)};  // of a message at least
  std::chrono::nanoseconds jitter{};                               // up to so much more, by chance
  std::chrono::nanoseconds repeat{std::chrono::milliseconds(5)};   // a lost one is sent again after this time
  double loss = 0;                                                 // share of messages, by chance
  std::int64_t seed = 1;                                           // of chance

  static constexpr std::chrono::nanoseconds kLeastDelay{std::chrono::microseconds(1)};
  static constexpr std::chrono::nanoseconds kLongest{std::chrono::seconds(10)};
  static constexpr double kMostLoss = 0.9;
};

}  // namespace indurop::config
