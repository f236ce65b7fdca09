// SPDX-License-Identifier: Apache-2.0
// A program with shared variables that no node started, as the test of a user's function is one: writes a variable and
// prints what it reads.
#include <indurop/generated.h>

#include <cstdio>

int main() {
  TEST_CELL::level = 2.5F;
  std::printf("%g\n", static_cast<double>(TEST_CELL::level));
}
