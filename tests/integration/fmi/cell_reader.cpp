// SPDX-License-Identifier: Apache-2.0
// Has the variables of the two boards without writing them.
#include <indurop/generated.h>
#include <indurop/indurop.h>

void onRun() {
  (void)cell::encoder.get();
  (void)cell::torque.get();
}

INDUROP_MODULE(run = &::onRun)
