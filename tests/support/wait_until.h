// SPDX-License-Identifier: Apache-2.0
// Waiting in tests: for a condition, never for a time.

#pragma once

#include <chrono>
#include <thread>

namespace indurop::test {

// Machines that run tests are slow and busy; no test fails for being slower than it should.
inline constexpr std::chrono::seconds kPatience{30};

// Waits until `condition` holds; false if it does not in all the time there is.
template <class Condition>
bool wait_until(Condition condition, std::chrono::milliseconds patience = kPatience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) {
      return condition();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace indurop::test
