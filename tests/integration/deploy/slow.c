// SPDX-License-Identifier: Apache-2.0
// Takes its time to start: until the test makes a file.
#include <stdlib.h>
#include <unistd.h>

void start(void) {
  const char* file = getenv("IRP_TEST_SLOW_UNTIL");
  while (file && access(file, F_OK) != 0) {
    usleep(10000);
  }
}
void run(void) {}
