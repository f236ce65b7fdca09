// SPDX-License-Identifier: Apache-2.0
// What one message costs, from its writing to its reader's having it, both in one thread: nobody is waited for, so no
// wake-up and no other program counts. The figure is the median of batches.

#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace peers {

// `exchange`: writes a message and reads it; false: it did not arrive.
template <class Exchange>
void measure(std::size_t bytes, const Exchange& exchange) {
  constexpr int kBatch = 500;
  std::array<double, 41> batches{};
  for (double& batch : batches) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kBatch; ++i) {
      if (!exchange()) {
        std::printf("{\"bytes\": %zu, \"ns\": null}\n", bytes);
        return;
      }
    }
    batch = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() / kBatch;
  }
  std::sort(batches.begin(), batches.end());
  std::printf("{\"bytes\": %zu, \"ns\": %.1f}\n", bytes, batches[batches.size() / 2]);
}

}  // namespace peers
