// SPDX-License-Identifier: Apache-2.0
// Runs well for three seconds, then takes longer than its period for a while.
#include <time.h>

static int runs;

static long long now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1000000000LL + time.tv_nsec;
}

void run(void) {
  ++runs;
  if (runs > 1500 && runs < 1540) {
    const long long until = now() + 7000000;
    while (now() < until) {
    }
  }
}
