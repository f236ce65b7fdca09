// SPDX-License-Identifier: Apache-2.0
// What became of the frames of a bus: the tick counts, a thread of the bus prints what went wrong.

#pragma once

#include <atomic>
#include <string>

#include "control/io/ethercat/master/master.h"

namespace indurop::io {

class EthercatLosses {
 public:
  // The counters as of this tick. Real-time safe.
  void set(const ethercat::BusCounters& counters) noexcept;
  // How many were late or lost since the last text that said so, at most every ten seconds; empty if none were. `now`:
  // monotonic. For one thread, which need not be that of set().
  std::string news(ethercat::Clock now);
  // Of all frames since the start. While no tick runs.
  [[nodiscard]] std::string total() const;

 private:
  ethercat::BusCounters all_;             // the tick's
  std::atomic<std::uint64_t> missed_{0};  // the tick writes, the thread reads
  std::uint64_t reported_ = 0;
  ethercat::Clock reported_at_{0};
};

}  // namespace indurop::io
