// SPDX-License-Identifier: Apache-2.0
// flock().
#include "core/rt/file_lock.h"

#include <sys/file.h>

#include <cerrno>

namespace indurop::rt {
namespace {

Status lock(int file, int operation) noexcept {
  while (::flock(file, operation) != 0) {
    if (errno != EINTR) {
      return Error{errno == EWOULDBLOCK ? Errc::Busy : Errc::System, errno, "lock a file"};
    }
  }
  return {};
}

int operation_of(FileLock kind) noexcept {
  return kind == FileLock::Shared ? LOCK_SH : LOCK_EX;
}

}  // namespace

Status lock_file(int file, FileLock kind) noexcept {
  return lock(file, operation_of(kind) | LOCK_NB);
}
Status lock_file_when_free(int file, FileLock kind) noexcept {
  return lock(file, operation_of(kind));
}

// There is no other way to check: a process that tries to lock at this very moment has to try again.
bool is_locked(int file) noexcept {
  const bool is_free = ::flock(file, LOCK_SH | LOCK_NB) == 0;
  if (is_free) {
    ::flock(file, LOCK_UN);
  }
  return !is_free && errno == EWOULDBLOCK;
}

}  // namespace indurop::rt
