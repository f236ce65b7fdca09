// SPDX-License-Identifier: Apache-2.0
// Runs after the press of its board, and proves that no run of both is left out.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdint>

namespace {

std::int64_t last = 0;

}  // namespace

void onRun() {
  xt::BOARD_TICKS = xt::BOARD_TICKS + 1;
  const std::int64_t now = xt::BOARD_TURNS;
  if (last != 0 && now != last + 1) {
    xt::BOARD_GAPS = xt::BOARD_GAPS + 1;
  }
  last = now;
}

INDUROP_STATE(last)
INDUROP_MODULE(run = &::onRun)
