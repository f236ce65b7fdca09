// SPDX-License-Identifier: Apache-2.0
// A process that does nothing until it is ended.
#include <unistd.h>

int main(void) {
  pause();
  return 0;
}
