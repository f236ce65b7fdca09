// SPDX-License-Identifier: Apache-2.0
#include "core/base/write_all.h"

#include <unistd.h>

#include <cerrno>

namespace indurop::base {

int write_all(int file, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) {
      return errno;
    }
    bytes.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace indurop::base
