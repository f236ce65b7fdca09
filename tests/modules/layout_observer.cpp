// SPDX-License-Identifier: Apache-2.0
// A program outside of the node: attaches as often as it reads a line and prints the result and what it sees.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdio>

int main() {
  for (int c = std::getchar(); c != EOF; c = std::getchar()) {
    const int result = irp::attach();
    const INDUROP_TYPEOF(nt_layout::axis)::value_type seen = nt_layout::axis;
    std::printf("attach %d, moves %s\n", result, seen.x > 0 ? "yes" : "no");
    std::fflush(stdout);
  }
  return 0;
}
