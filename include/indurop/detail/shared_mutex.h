// SPDX-License-Identifier: Apache-2.0
// Space for a lock in shared memory. Its content depends on the system: only core/rt/shared_mutex.h knows it.

#pragma once

namespace indurop::abi {

struct alignas(8) SharedMutex {
  unsigned char bytes[72];
};

}  // namespace indurop::abi
