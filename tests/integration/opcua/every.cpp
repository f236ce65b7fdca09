// SPDX-License-Identifier: Apache-2.0
// Counts its runs, and sets what a .glb cannot.
#include <indurop/generated.h>
#include <indurop/indurop.h>

void onStart() {
  INDUROP_TYPEOF(every::point) point = every::point;
  point.x = 1.5;
  point.valid = true;
  point.grid[0][1] = 2;
  point.grid[1][2] = 6;
  point.mode = every::MANUAL;
  every::point = point;
  every::numbers[3] = -7;
  every::matrix[1][2] = 12.5;
}

void onRun() {
  every::count = every::count + 1;
  every::points[1].y = static_cast<double>(every::count);
}

INDUROP_MODULE(run = &::onRun, start = &::onStart, name = "every")
