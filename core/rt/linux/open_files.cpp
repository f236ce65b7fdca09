// SPDX-License-Identifier: Apache-2.0
// All files at once, by a call that POSIX does not have.
#include "core/rt/open_files.h"

#include <linux/close_range.h>
#include <unistd.h>

#include <limits>

namespace indurop::rt {

void close_open_files_on_exec() noexcept {
  constexpr unsigned int kFirst = STDERR_FILENO + 1;
  static_cast<void>(::close_range(kFirst, std::numeric_limits<unsigned int>::max(), CLOSE_RANGE_CLOEXEC));
}

}  // namespace indurop::rt
