// SPDX-License-Identifier: Apache-2.0
// A program in addition to the I/O module: inputs are written to outputs, changed so that it cannot be mistaken.
#include <indurop/generated.h>
#include <indurop/indurop.h>

using namespace TEST_CELL;

void onRun() {
  O0 = static_cast<std::int16_t>(I0 != 0 ? 0 : 1);
  speeds[0] = speeds[1] + 100;
  speeds[2] = static_cast<std::int32_t>(pressure * 10);
}

INDUROP_MODULE(run = &::onRun)
