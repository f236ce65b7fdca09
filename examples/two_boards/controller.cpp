// SPDX-License-Identifier: Apache-2.0
// The control board's module: keeps the table at its target speed, as long as it knows how fast the table is.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>

using namespace cell;

namespace {

constexpr double kGain = 0.8;       // Nm s
constexpr double kIntegral = 4.0;   // Nm
constexpr double kStep = 0.001;     // s
constexpr double kMaxTorque = 5.0;  // Nm

double sum = 0;

}  // namespace

void onRun() {
  if (!valid(encoder)) {
    sum = 0;
    torque = 0;
    return;
  }
  const Encoder now = encoder;
  const double error = target - now.speed;
  sum = std::clamp(sum + kStep * kIntegral * error, -kMaxTorque, kMaxTorque);
  torque = std::clamp(kGain * error + sum, -kMaxTorque, kMaxTorque);
  echo = now.count;
}

INDUROP_MODULE(run = &::onRun)
