// SPDX-License-Identifier: Apache-2.0
// Locks of open file descriptions, POSIX.1-2024.
#include "core/rt/file_lock.h"

#include <fcntl.h>

#include <cerrno>

namespace indurop::rt {
namespace {

Status lock(int file, int command, FileLock kind) noexcept {
  struct flock whole {};
  whole.l_type = kind == FileLock::Shared ? F_RDLCK : F_WRLCK;
  whole.l_whence = SEEK_SET;
  while (::fcntl(file, command, &whole) != 0) {
    if (errno != EINTR) {
      return Error{errno == EAGAIN || errno == EACCES ? Errc::Busy : Errc::System, errno, "lock a file"};
    }
  }
  return {};
}

}  // namespace

Status lock_file(int file, FileLock kind) noexcept {
  return lock(file, F_OFD_SETLK, kind);
}
Status lock_file_when_free(int file, FileLock kind) noexcept {
  return lock(file, F_OFD_SETLKW, kind);
}

bool is_locked(int file) noexcept {
  struct flock whole {};
  whole.l_type = F_RDLCK;
  whole.l_whence = SEEK_SET;
  return ::fcntl(file, F_OFD_GETLK, &whole) == 0 && whole.l_type != F_UNLCK;
}

}  // namespace indurop::rt
