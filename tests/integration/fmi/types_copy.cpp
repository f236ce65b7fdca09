// SPDX-License-Identifier: Apache-2.0
// Copies a value of each type, and faults in the run that a variable names.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <stdexcept>

using namespace kinds;

void onRun() {
  out = in.get();
  runs = runs + 1 + (limited > 1e9 ? 1U : 0U);
  if (faulty != 0 && runs == faulty) {
    throw std::runtime_error("as requested");
  }
}

INDUROP_MODULE(run = &::onRun)
