// SPDX-License-Identifier: Apache-2.0
// Counts its runs.
#include <indurop/generated.h>
#include <indurop/indurop.h>

void onRun() {
  doors::count = doors::count + 1;
  doors::twice = 2.0 * static_cast<double>(doors::count);
}

INDUROP_MODULE(run = &::onRun, name = "counting")
