// SPDX-License-Identifier: Apache-2.0
// A process module that writes a large variable without pause, for tests that kill it in the middle of a write.
#include <indurop/generated.h>
#include <indurop/indurop.h>

int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  INDUROP_TYPEOF(nt::block)::value_type value = nt::block;
  while (irp::waitPeriod()) {
    for (int i = 0; i < 200; ++i) {
      for (auto& word : value.word) {
        ++word;
      }
      nt::block = value;
    }
  }
  return 0;
}
