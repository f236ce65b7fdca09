// SPDX-License-Identifier: Apache-2.0
// A process module that implements nt::add.
#include <indurop/generated.h>
#include <indurop/indurop.h>

INDUROP_IMPLEMENT(nt::add, [](double a, double b) { return a + b; })

int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  while (irp::waitPeriod()) {
  }
  return 0;
}
