// SPDX-License-Identifier: Apache-2.0
// The version of the library, as CMakeLists.txt states it.
#include <indurop/c.h>

const char* irp_version(void) {
  return INDUROP_VERSION;
}
