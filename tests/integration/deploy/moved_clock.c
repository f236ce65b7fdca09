// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program it moves the program's CLOCK_REALTIME by IRP_TEST_CLOCK_S seconds, or by what stands in the
// file IRP_TEST_CLOCK_FILE (8 bytes), which may change meanwhile: what a board whose clock is wrong, or is put right, sees.
// Waits until an instant of that clock are moved back, because the kernel's own clock is right.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static const volatile int64_t* shared(const char* name) {
  const int file = name == NULL ? -1 : open(name, O_RDONLY | O_CLOEXEC);
  void* found = file < 0 ? MAP_FAILED : mmap(NULL, sizeof(int64_t), PROT_READ, MAP_SHARED, file, 0);
  if (file >= 0) {
    close(file);
  }
  return found == MAP_FAILED ? NULL : found;
}

static time_t ahead(void) {
  static time_t seconds;
  static const volatile int64_t* moving;
  static int known;
  if (!known) {
    const char* text = getenv("IRP_TEST_CLOCK_S");
    seconds = text == NULL ? 0 : (time_t)atoll(text);
    moving = shared(getenv("IRP_TEST_CLOCK_FILE"));
    known = 1;
  }
  return moving != NULL ? (time_t)*moving : seconds;
}

static int is_wall(clockid_t clock) {
  return clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE || clock == CLOCK_TAI;
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  const long code = syscall(SYS_clock_gettime, clock, now);
  if (code == 0 && is_wall(clock)) {
    now->tv_sec += ahead();
  }
  return (int)code;
}

int gettimeofday(struct timeval* restrict now, void* restrict zone) {
  struct timespec exact;
  (void)zone;
  clock_gettime(CLOCK_REALTIME, &exact);
  now->tv_sec = exact.tv_sec;
  now->tv_usec = exact.tv_nsec / 1000;
  return 0;
}

time_t time(time_t* out) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != NULL) {
    *out = now.tv_sec;
  }
  return now.tv_sec;
}

// The instant as the kernel counts it. Conditions may use CLOCK_MONOTONIC as well, whose instants are far from this clock.
static struct timespec back(const struct timespec* instant) {
  const time_t day = 24 * 3600;
  struct timespec now;
  struct timespec out = *instant;
  clock_gettime(CLOCK_REALTIME, &now);
  if (instant->tv_sec > now.tv_sec - day && instant->tv_sec < now.tv_sec + day) {
    out.tv_sec -= ahead();
  }
  return out;
}

// A wait is looked at again every few milliseconds: the kernel, too, notices that its clock is put back, and goes on
// waiting until the instant comes.
static int is_over(const struct timespec* instant) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec > instant->tv_sec || (now.tv_sec == instant->tv_sec && now.tv_nsec >= instant->tv_nsec);
}

static struct timespec soon(const struct timespec* instant) {
  const long piece = 5000000;
  struct timespec out;
  struct timespec moved = back(instant);
  syscall(SYS_clock_gettime, CLOCK_REALTIME, &out);
  out.tv_nsec += piece;
  out.tv_sec += out.tv_nsec / 1000000000;
  out.tv_nsec %= 1000000000;
  return moved.tv_sec < out.tv_sec || (moved.tv_sec == out.tv_sec && moved.tv_nsec < out.tv_nsec) ? moved : out;
}

int pthread_cond_timedwait(pthread_cond_t* restrict condition, pthread_mutex_t* restrict mutex,
                           const struct timespec* restrict instant) {
  static int (*next)(pthread_cond_t*, pthread_mutex_t*, const struct timespec*);
  if (next == NULL) {
    // Without a version this would be the one of 2002, whose conditions look different.
    void* found = dlvsym(RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2");
    *(void**)&next = found != NULL ? found : dlsym(RTLD_NEXT, "pthread_cond_timedwait");
  }
  const struct timespec as_it_is = back(instant);
  if (as_it_is.tv_sec == instant->tv_sec && ahead() != 0) {
    return next(condition, mutex, instant);  // of CLOCK_MONOTONIC
  }
  for (;;) {
    const struct timespec moved = soon(instant);
    const int result = next(condition, mutex, &moved);
    if (result != ETIMEDOUT || is_over(instant)) {
      return result;
    }
  }
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const struct timespec* instant) {
  static int (*next)(pthread_cond_t*, pthread_mutex_t*, clockid_t, const struct timespec*);
  if (next == NULL) {
    *(void**)&next = dlsym(RTLD_NEXT, "pthread_cond_clockwait");
  }
  const struct timespec moved = is_wall(clock) ? back(instant) : *instant;
  return next(condition, mutex, clock, &moved);
}

int sem_timedwait(sem_t* restrict semaphore, const struct timespec* restrict instant) {
  static int (*next)(sem_t*, const struct timespec*);
  if (next == NULL) {
    *(void**)&next = dlsym(RTLD_NEXT, "sem_timedwait");
  }
  const struct timespec moved = back(instant);
  return next(semaphore, &moved);
}

int clock_nanosleep(clockid_t clock, int flags, const struct timespec* until, struct timespec* rest) {
  struct timespec moved = *until;
  if (is_wall(clock) && (flags & TIMER_ABSTIME) != 0) {
    moved.tv_sec -= ahead();
  }
  return syscall(SYS_clock_nanosleep, clock, flags, &moved, rest) == 0 ? 0 : errno;
}
