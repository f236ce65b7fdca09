// SPDX-License-Identifier: Apache-2.0
// One of many boards: writes its hundred variables, reads those of all others, notes when it had all of them at last.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <cstdint>
#include <ctime>

#include "many.h"

namespace {

std::int64_t wall_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

void onRun() {
  static std::uint32_t round = 0;
  bench::many::write_own(++round);
  bench::many::note(wall_ns());
}

// The store may be one that a killed node left.
void onStart() {
  bench::many::not_matched();
}

INDUROP_MODULE(start = &::onStart, run = &::onRun)
