// SPDX-License-Identifier: Apache-2.0
// Takes its time to start.
#include <unistd.h>

void start(void) {
  sleep(3);
}
void run(void) {}
