// SPDX-License-Identifier: Apache-2.0
// The agent of a release that passes every check and then does nothing.
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int main(int count, char** words) {
  if (count > 1 && strcmp(words[1], "--version") == 0) {
    puts("9.9");
    return 0;
  }
  for (;;) {
    pause();
  }
}
