// SPDX-License-Identifier: Apache-2.0
// Says what its properties and its own globals are; two modules of this file must not share them.
#include <indurop/indurop.h>

#include <string>

namespace {
int own = 0;
std::string label;
int add = 0;
}  // namespace

void onStart() {
  label = irp::property<std::string>("label", "none");
  add = irp::property<int>("add", 1);
}

void onRun() {
  if (own < 10 * add) {
    own += add;
    if (own == 10 * add) {
      irp::printf("%s has %d\n", label, own);
    }
  }
}

void onStop() {
  irp::printf("%s ends with %d\n", label, own);
}

INDUROP_MODULE(run = &::onRun, start = &::onStart, stop = &::onStop)
