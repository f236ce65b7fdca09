// SPDX-License-Identifier: Apache-2.0
// -w: repeats the output of a verb, repainted in place on a terminal.

#pragma once

#include <cstdint>
#include <functional>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct Repeat {
  bool on = false;
  bool once = false;
  std::uint64_t count = 0;  // 0: without end
  std::int64_t interval_ns = 1'000'000'000;
  std::int64_t timeout_ns = 0;  // 0: none
};

// Adds -w, --once, -n COUNT, --interval and --timeout.
void add_repeat_options(base::Options& app, Repeat& repeat);

// Calls `round` once, or with -w until the count, the time-out, Ctrl-C or until the reader has gone. Returns the code
// of the last round.
int repeat_rounds(Context& context, const Repeat& repeat, const std::function<int()>& round);

}  // namespace indurop::tools
