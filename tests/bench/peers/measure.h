// SPDX-License-Identifier: Apache-2.0
// What one message costs, from its writing to its reader's having it, both in one thread: no thread waits, so no
// wake-up and no other program counts. The figure is the median of batches. Before the first one: what it took until a
// message had arrived since the program was started, and the memory by then.

#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace peers {

// PEERS_STARTED: when the program was started, nanoseconds of CLOCK_MONOTONIC.
inline void tell_start() {
  static bool reported = false;
  const char* const started = std::getenv("PEERS_STARTED");
  std::FILE* const file = reported ? nullptr : std::fopen("/proc/self/statm", "re");
  unsigned long resident = 0;
  if (file != nullptr && started != nullptr && std::fscanf(file, "%*u %lu", &resident) == 1) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    std::printf("{\"start_ms\": %.1f, \"resident_mb\": %.1f}\n",
                std::chrono::duration<double, std::milli>(now).count() - std::atof(started) / 1e6,
                static_cast<double>(resident) * 4096 / 1e6);
  }
  if (file != nullptr) {
    std::fclose(file);
  }
  reported = true;
}

// `exchange`: writes a message and reads it; false: it did not arrive.
template <class Exchange>
void measure(std::size_t bytes, const Exchange& exchange) {
  constexpr int kBatch = 500;
  std::array<double, 41> batches{};
  if (exchange()) {
    tell_start();
  }
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
