// SPDX-License-Identifier: Apache-2.0
// What senders and receivers count, for the program's report. Written by one thread, read by another one.

#pragma once

#include <atomic>
#include <cstdint>

namespace indurop::pool_door {

using Count = std::atomic<std::uint64_t>;

struct SendCounts {
  std::atomic<int> readers{0};  // that are matched now
  Count sent{0};                // chunks, to all readers
  Count bytes{0};               // of these chunks
  Count by_rate{0};             // chunks not sent because of --hz
  Count superseded{0};          // chunks not sent because a newer one was there before the network was ready
  Count abandoned{0};           // chunks sent in part: the network did not accept more in time
};

struct ReceiveCounts {
  std::atomic<int> senders{0};  // that are matched now
  Count received{0};            // chunks published to the local pool
  Count bytes{0};               // of these chunks
  Count incomplete{0};          // chunks of which parts were lost
  Count no_chunk{0};            // chunks for which no local chunk was free
  Count refused{0};             // parts of another type, or without a local pool
};

}  // namespace indurop::pool_door
