// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program it moves the program's CLOCK_REALTIME by IRP_TEST_CLOCK_S seconds: what a board whose clock is
// wrong sees. Waits until an instant of that clock are moved back, because the kernel's own clock is right.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static time_t ahead(void) {
  static time_t seconds;
  static int known;
  if (!known) {
    const char* text = getenv("IRP_TEST_CLOCK_S");
    seconds = text == NULL ? 0 : (time_t)atoll(text);
    known = 1;
  }
  return seconds;
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

int pthread_cond_timedwait(pthread_cond_t* restrict condition, pthread_mutex_t* restrict mutex,
                           const struct timespec* restrict instant) {
  static int (*next)(pthread_cond_t*, pthread_mutex_t*, const struct timespec*);
  if (next == NULL) {
    // Without a version this would be the one of 2002, whose conditions look different.
    void* found = dlvsym(RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2");
    *(void**)&next = found != NULL ? found : dlsym(RTLD_NEXT, "pthread_cond_timedwait");
  }
  const struct timespec moved = back(instant);
  return next(condition, mutex, &moved);
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
