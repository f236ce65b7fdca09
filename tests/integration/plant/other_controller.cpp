// SPDX-License-Identifier: Apache-2.0
// A changed controller of the turning table, for a replay: it always pushes as hard as the table bears.
#include <indurop/indurop.h>

#include <indurop/generated.h>

void onRun() {
  const cell::Encoder now = cell::encoder;
  cell::echo = now.count;
  cell::torque = 5;
}

INDUROP_MODULE(run = &::onRun)
