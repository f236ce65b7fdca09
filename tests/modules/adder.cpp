// SPDX-License-Identifier: Apache-2.0
// Adds STEP to nt::sum, which it reads itself, and keeps nothing. Its versions differ in STEP only.
#include <indurop/generated.h>
#include <indurop/indurop.h>

void onRun() {
  nt::sum = nt::sum + STEP;
  nt::answers = nt::answers + 1;
}

INDUROP_STATE()
INDUROP_MODULE(run = &::onRun)
