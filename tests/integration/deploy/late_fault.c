// SPDX-License-Identifier: Apache-2.0
// Runs well for three seconds, then writes where nothing is.
static int runs;
__attribute__((no_sanitize("undefined"))) void run(void) {
  if (++runs > 1500) {
    *(volatile int*)0 = 0;
  }
}
