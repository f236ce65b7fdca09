// SPDX-License-Identifier: Apache-2.0
#include "base/log.h"

#include <cstdio>

namespace indurop::base {

void Log::line(std::string_view kind, std::string_view text) const {
  std::fflush(stdout);
  fmt::print(stderr, "{}: {}{}\n", who_, kind, text);
}

}  // namespace indurop::base
