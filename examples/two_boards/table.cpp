// SPDX-License-Identifier: Apache-2.0
// The sensor board's module: the table itself (simulated), its encoder and its motor.
#include <indurop/indurop.h>

#include <indurop/generated.h>

using namespace cell;

namespace {

constexpr double kInertia = 0.05;   // kg m2
constexpr double kFriction = 0.02;  // Nm s
constexpr double kStep = 0.001;     // s, the module's period

double speed = 0;
double angle = 0;
uint64_t count = 0;

}  // namespace

void onRun() {
  speed += kStep * (torque - kFriction * speed) / kInertia;
  angle += kStep * speed;
  encoder = Encoder{angle, speed, ++count};
  lag = count - echo;
}

INDUROP_MODULE(run = &::onRun)
