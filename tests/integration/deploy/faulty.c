// SPDX-License-Identifier: Apache-2.0
// Runs for a while, then writes where nothing is.
static int runs;
__attribute__((no_sanitize("undefined"))) void run(void) {
  if (++runs > 100) {
    *(volatile int*)0 = 0;
  }
}
