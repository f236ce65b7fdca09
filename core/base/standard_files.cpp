// SPDX-License-Identifier: Apache-2.0
#include "core/base/standard_files.h"

#include <fcntl.h>
#include <unistd.h>

namespace indurop::base {

void open_standard_files() noexcept {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) < 0) {
      (void)::open("/dev/null", O_RDWR);  // takes the lowest number that is free: this one. Children get it, too
    }
  }
}

}  // namespace indurop::base
