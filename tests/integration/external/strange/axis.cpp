// SPDX-License-Identifier: Apache-2.0
// An axis of another release: its state has other fields.
#include <indurop/indurop.h>

#include <indurop/generated.h>

void onRun() {
  station::State now = station::state;
  ++now.cycle;
  now.position = 1.5F;
  station::state = now;
}

INDUROP_MODULE(run = &::onRun)
