// SPDX-License-Identifier: Apache-2.0
// Prints `lines` in every run: by default far more than anybody can read.
#include <indurop/indurop.h>

namespace {
unsigned line = 0;
int lines = 0;
}  // namespace

void onStart() {
  lines = irp::property<int>("lines", 2000);
}

void onRun() {
  for (int i = 0; i < lines; ++i) {
    irp::printf("flood %u\n", ++line);
  }
}

INDUROP_MODULE(start = &::onStart, run = &::onRun)
