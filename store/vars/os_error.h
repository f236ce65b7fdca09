// SPDX-License-Identifier: Apache-2.0
// Maps errors of the operating system to error codes of this folder.

#pragma once

#include <indurop/result.h>

#include <cerrno>

namespace indurop::vars {

// `error` is an errno. Everything without a specific code is Errc::System.
inline Error os_error(int error, const char* where) noexcept {
  switch (error) {
    case ENOENT:
      return {Errc::NotFound, error, where};
    case EACCES:
    case EPERM:
    case EROFS:
    case ELOOP:  // a symbolic link where a file should be
      return {Errc::PermissionDenied, error, where};
    case EEXIST:
      return {Errc::AlreadyExists, error, where};
    case ENOSPC:
    case EDQUOT:
    case ENOMEM:
    case EFBIG:
    case EAGAIN:  // mmap beyond the limit of locked memory
      return {Errc::NoSpace, error, where};
    default:
      return {Errc::System, error, where};
  }
}

}  // namespace indurop::vars
