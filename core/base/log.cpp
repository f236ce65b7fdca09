// SPDX-License-Identifier: Apache-2.0
#include "core/base/log.h"

#include <cstdio>

#include "core/base/printable.h"

namespace indurop::base {

void Log::line(std::string_view kind, std::string_view text) const {
  std::fflush(stdout);
  fmt::print(stderr, "{}: {}{}\n", who_, kind, printable(text, "\t"));
}

}  // namespace indurop::base
