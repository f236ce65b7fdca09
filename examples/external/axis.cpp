// SPDX-License-Identifier: Apache-2.0
// Moves the axis to its target. Knows nothing of those who watch it or set the target.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>
#include <cmath>

using namespace station;

namespace {

constexpr double kStep = 0.1;  // mm per ms
double position = 0;
uint64_t cycle = 0;

}  // namespace

void onRun() {
  const double way = target - position;
  const double step = std::clamp(way, -kStep, kStep);
  position += step;
  State now{};
  now.cycle = ++cycle;
  now.position = position;
  now.force = {static_cast<float>(step), 9.5F, -9.5F};
  now.mode = std::abs(way) < 1e-6 ? ARRIVED : MOVING;
  now.inside = position <= limit;
  now.program = "pick and place";
  state = now;
}

INDUROP_MODULE(run = &::onRun)
