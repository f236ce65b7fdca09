// SPDX-License-Identifier: Apache-2.0
// One file after the other.
#include "core/rt/open_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace indurop::rt {

void close_open_files_on_exec() noexcept {
  constexpr long kMostFiles = 65536;
  const long limit = ::sysconf(_SC_OPEN_MAX);
  const int end = static_cast<int>(limit < 0 ? kMostFiles : std::min(limit, kMostFiles));
  for (int file = STDERR_FILENO + 1; file < end; ++file) {
    if (const int flags = ::fcntl(file, F_GETFD); flags >= 0) {
      static_cast<void>(::fcntl(file, F_SETFD, flags | FD_CLOEXEC));
    }
  }
}

}  // namespace indurop::rt
