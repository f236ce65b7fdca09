// SPDX-License-Identifier: Apache-2.0
// Room for a lock in shared memory. What lies in it depends on the system: rt/shared_mutex.h knows, nobody else.

#pragma once

namespace indurop::abi {

struct alignas(8) SharedMutex {
  unsigned char bytes[72];
};

}  // namespace indurop::abi
