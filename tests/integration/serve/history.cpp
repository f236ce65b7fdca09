// SPDX-License-Identifier: Apache-2.0
// Writes variables that change in each run, in every 50th, or as two modules take turns.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdio>

void onRun() {
  const std::uint64_t count = past::count + 1;
  past::count = count;
  past::slow = static_cast<std::int32_t>(count / 50) + past::parameter;
  past::wave = static_cast<double>(count % 7) * 0.25;
  past::both = {-static_cast<std::int64_t>(count), 0.5};
  past::pairs[1] = {static_cast<std::int64_t>(count / 10), 1.5};
  if (count % 20 == 0) {
    char text[16];
    (void)std::snprintf(text, sizeof text, "c%u", static_cast<unsigned>(count));
    past::text = text;
  }
}

INDUROP_MODULE(run = &::onRun, name = "history")
