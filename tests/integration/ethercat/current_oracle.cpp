// SPDX-License-Identifier: Apache-2.0
// The current loop of examples/ethercat_current computed a second time, from what is known of it only: the bandwidth of
// the winding, inertia and damping, the gain, and that a set point is at the motor from the next tick on. Compares each
// set point and each torque to the last bit, and the position with the exact motion.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace {

constexpr double kPeriod = 100e-6;
constexpr double kWinding = 2 * 3.14159265358979323846 * 32;  // 1/s
constexpr double kGain = 5;
constexpr double kNewtonMetre = 0.2;  // of 0.1 % of the motor's torque
constexpr double kInertia = 0.5;
constexpr double kDamping = 1;
constexpr double kCounts = 1'320'000 / (2 * 3.14159265358979323846);  // in a radian

struct Motor {
  double torque = 0;    // 0.1 %
  double speed = 0;     // rad/s
  double position = 0;  // rad
};
struct Oracle {
  std::int64_t errors = 0;     // sum of wanted - torque: whole numbers, so it is exact
  std::array<Motor, 3> ahead;  // the motor in the frame of this tick, of the next one, and of that after it
};
Oracle oracle;

// The solution of the motion with constant voltage at the winding, and with the torque that it has at the end.
Motor after_period(const Motor& before, double voltage) {
  const double slows = std::exp(-kDamping / kInertia * kPeriod);
  Motor motor;
  motor.torque = voltage + (before.torque - voltage) * std::exp(-kWinding * kPeriod);
  const double speed = motor.torque * kNewtonMetre / kDamping;  // in the end, if it lasted
  motor.speed = speed + (before.speed - speed) * slows;
  motor.position = before.position + speed * kPeriod + (before.speed - speed) * kInertia / kDamping * (1 - slows);
  return motor;
}

}  // namespace

void run() {
  const auto state = CURRENT::state.get();
  if (!state.enabled) {
    return;
  }
  const auto feedback = CURRENT::feedback.get();
  auto judgement = ORACLE::judgement.get();
  const auto torque = std::lround(oracle.ahead[0].torque);
  const std::int64_t wanted = judgement.compared / 100 % 2 == 0 ? 100 : -100;
  const std::int64_t error = wanted - torque;
  oracle.errors += error;
  const auto voltage =
      std::lround(kGain * (static_cast<double>(error) + kWinding * kPeriod * static_cast<double>(oracle.errors)));
  if (feedback.torque != torque || CURRENT::command.get().torque != voltage) {
    judgement.first = judgement.different == 0 ? judgement.compared : judgement.first;
    ++judgement.different;
  }
  judgement.farthest = std::max(judgement.farthest, std::abs(feedback.position - oracle.ahead[0].position * kCounts));
  ++judgement.compared;
  oracle.ahead = {oracle.ahead[1], oracle.ahead[2], after_period(oracle.ahead[2], static_cast<double>(voltage))};
  ORACLE::judgement = judgement;
}

INDUROP_STATE(oracle)
INDUROP_MODULE(run = &::run)
