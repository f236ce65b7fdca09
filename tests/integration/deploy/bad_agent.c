// SPDX-License-Identifier: Apache-2.0
// The agent of a release that passes every check and does not do well: it ends at once, and writes to
// IRP_TEST_BAD_AGENT how many seconds the kernel would have let it live.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int main(int count, char** words) {
  if (count > 1 && strcmp(words[1], "--version") == 0) {
    puts("9.9");
    return 0;
  }
  const char* log = getenv("IRP_TEST_BAD_AGENT");
  FILE* file = log != NULL ? fopen(log, "a") : NULL;
  if (file != NULL) {
    fprintf(file, "%u\n", alarm(0));
    fclose(file);
  }
  return 1;
}
