// SPDX-License-Identifier: Apache-2.0
// The kernel interrupts all processors; if it is too old for that, the function waits.
#include "core/rt/barrier.h"

#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "core/rt/clock.h"

namespace indurop::rt {

void barrier_on_all_processors() noexcept {
  if (::syscall(SYS_membarrier, MEMBARRIER_CMD_GLOBAL, 0, 0) != 0) {
    constexpr std::int64_t kStoresAreOutNs = 10'000'000;  // a processor delays a store for well below a microsecond
    sleep_until(now_ns() + kStoresAreOutNs);
  }
}

}  // namespace indurop::rt
