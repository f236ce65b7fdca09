// SPDX-License-Identifier: Apache-2.0
// A module that does ACCESS a number of TIMES: what its execution takes more than that of one whose access is nothing
// is what the access takes.
#include <indurop/generated.h>
#include <indurop/indurop.h>

namespace {

using Three = INDUROP_TYPEOF(counted::bytes24)::value_type;
using Many = INDUROP_TYPEOF(counted::bytes256)::value_type;

Three three;
Many many;

// Keeps the compiler from removing results that are not used.
template <class T>
void used(const T& value) {
  asm volatile("" : : "m"(value) : "memory");
}

}  // namespace

void on_run() {
  for (std::uint32_t n = 0; n != TIMES; ++n) {
    ACCESS;
    used(n);
  }
}

INDUROP_MODULE(run = &::on_run)
