// SPDX-License-Identifier: Apache-2.0
// Processors cannot be notified, but none delays a store for long.
#include "core/rt/barrier.h"

#include <atomic>

#include "core/rt/clock.h"

namespace indurop::rt {

void barrier_on_all_processors() noexcept {
  constexpr std::int64_t kStoresAreOutNs = 10'000'000;  // a processor delays a store for well below a microsecond
  std::atomic_thread_fence(std::memory_order_seq_cst);
  sleep_until(now_ns() + kStoresAreOutNs);
}

}  // namespace indurop::rt
