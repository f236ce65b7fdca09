// SPDX-License-Identifier: Apache-2.0
// Prints far more in every run than anybody can read.
#include <indurop/indurop.h>

namespace {
unsigned line = 0;
}

void onRun() {
  for (int i = 0; i < 2000; ++i) {
    irp::printf("flood %u\n", ++line);
  }
}

INDUROP_MODULE(run = &::onRun)
