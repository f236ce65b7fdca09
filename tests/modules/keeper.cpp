// SPDX-License-Identifier: Apache-2.0
// Keeps a number inside that begins again with each start, and shows it.
#include <indurop/generated.h>
#include <indurop/indurop.h>

namespace {
std::int64_t own = 0;
}  // namespace

void onStart() {
  own = 1000;
}

void onRun() {
  nt::walked = ++own;
}

INDUROP_MODULE(run = &::onRun, start = &::onStart)
