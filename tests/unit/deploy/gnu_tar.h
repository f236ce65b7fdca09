// SPDX-License-Identifier: Apache-2.0
// For tests whose yardstick is GNU tar: a small machine has only busybox.

#pragma once

#include <cstdlib>

namespace indurop::deploy {

inline bool has_gnu_tar() {
  return std::system("tar --version | grep -q GNU") == 0;
}

}  // namespace indurop::deploy
