// SPDX-License-Identifier: Apache-2.0
// A well-behaved module: counts its runs, says hello and goodbye, and has a global of its own.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <string>

namespace {
int own = 0;
std::string label;
}  // namespace

void onStart() {
  label = irp::property<std::string>("label", "counter");
  irp::printf("%s starts with counted %u, kept %u\n", label, nt::counted, nt::kept);
}

void onRun() {
  ++own;
  ++nt::counted;
  ++nt::kept;
}

void onStop() {
  irp::printf("%s stops after %d runs of its own\n", label, own);
}

INDUROP_MODULE(run = &::onRun, start = &::onStart, stop = &::onStop)
