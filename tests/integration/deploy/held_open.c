// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program it makes the program wait, as if the disk hung, when it opens a file whose name contains
// IRP_TEST_HELD, as long as the file IRP_TEST_HELD_WHILE exists.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static void wait_for(const char* path) {
  const char* held = getenv("IRP_TEST_HELD");
  const char* gate = getenv("IRP_TEST_HELD_WHILE");
  if (held == NULL || gate == NULL || strstr(path, held) == NULL) {
    return;
  }
  while (access(gate, F_OK) == 0) {
    const struct timespec moment = {0, 5000000};
    nanosleep(&moment, NULL);
  }
}

typedef int (*Open)(const char*, int, ...);

static int held_open(const char* name, const char* path, int flags, mode_t mode) {
  Open next = NULL;
  *(void**)&next = dlsym(RTLD_NEXT, name);
  wait_for(path);
  return next(path, flags, mode);
}

static mode_t mode_in(int flags, va_list rest) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
}

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_in(flags, rest);
  va_end(rest);
  return held_open("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_in(flags, rest);
  va_end(rest);
  return held_open("open64", path, flags, mode);
}
