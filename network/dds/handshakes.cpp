// SPDX-License-Identifier: Apache-2.0
#include "network/dds/handshakes.h"

#include <dds/ddsrt/time.h>
#include <dlfcn.h>

extern "C" {

struct dds_security_fsm;  // its header cannot be read as C++

// Cyclone calls it once for each handshake, with the limit of 100 s.
[[gnu::visibility("default")]] void dds_security_fsm_set_timeout(dds_security_fsm* /*handshake*/,
                                                                 void (* /*give_up*/)(dds_security_fsm*, void*),
                                                                 dds_time_t /*limit*/) {}

}  // extern "C"

namespace indurop::dds {

bool handshakes_are_unlimited() noexcept {
  return ::dlsym(RTLD_DEFAULT, "dds_security_fsm_set_timeout") ==
         reinterpret_cast<const void*>(&dds_security_fsm_set_timeout);
}

}  // namespace indurop::dds
