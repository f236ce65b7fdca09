// SPDX-License-Identifier: Apache-2.0
// Closes the loop of a motor's torque: a PI controller whose zero cancels the pole of the winding, so that the torque
// follows with the loop's bandwidth, 160 Hz, instead of the winding's, 32 Hz. A square wave shows it.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWinding = 2 * kPi * 32;  // 1/s
constexpr double kGain = 5;
constexpr double kLimit = 1000;      // what the drive can, 0.1 %
constexpr double kTorque = 100;      // amplitude of the square wave, 0.1 %
constexpr double kTolerance = 4;     // 2 % of a step from one side to the other
constexpr std::int64_t kHalf = 100;  // runs on each side
constexpr std::uint16_t kStateBits = 0x6F;
constexpr std::uint16_t kEnabled = 0x27;
constexpr std::int8_t kCyclicTorque = 10;

struct Loop {
  double integral = 0;
  std::int64_t runs = 0;     // since the drive was enabled
  std::int64_t outside = 0;  // runs of this step until the torque stayed within the tolerance
};
Loop loop;

std::uint16_t next_control(std::uint16_t status) {
  constexpr std::uint16_t kShutdown = 6;
  constexpr std::uint16_t kSwitchOn = 7;
  constexpr std::uint16_t kEnable = 15;
  constexpr std::uint16_t kReset = 0x80;
  switch (status & kStateBits) {
    case 0x21:
      return kSwitchOn;
    case 0x23:
    case kEnabled:
      return kEnable;
    default:
      return (status & 0x08U) != 0 ? kReset : kShutdown;
  }
}

// The integral waits while the drive is at its limit.
double control_torque(double wanted, double torque) {
  const double error = wanted - torque;
  const double seconds = static_cast<double>(irp::period().count()) * 1e-9;
  const double integral = loop.integral + kGain * kWinding * seconds * error;
  const double output = kGain * error + integral;
  if (std::abs(output) <= kLimit) {
    loop.integral = integral;
  }
  return std::clamp(output, -kLimit, kLimit);
}

// Measures the step that goes on, and begins the next one when it is its time.
template <class State>
void update_step(State& state, double torque) {
  const std::int64_t since = loop.runs % kHalf;
  if (since == 0 && loop.runs > 0) {
    ++state.steps;
    state.settled = static_cast<double>(loop.outside) * static_cast<double>(irp::period().count()) * 1e-3;
    state.slowest = std::max(state.slowest, state.settled);
  }
  state.overshoot = std::max(state.overshoot, std::abs(torque) - kTorque);
  state.wanted = loop.runs / kHalf % 2 == 0 ? kTorque : -kTorque;
  if (std::abs(torque - state.wanted) > kTolerance) {
    loop.outside = since + 1;
  }
  ++loop.runs;
}

}  // namespace

void run() {
  const auto feedback = CURRENT::feedback.get();
  auto command = CURRENT::command.get();
  auto state = CURRENT::state.get();
  if (CURRENT::quality.get() != 1) {
    // Nothing new: without the loop the winding gets there alone, slowly.
    command.torque = static_cast<std::int16_t>(std::lround(state.wanted));
    CURRENT::command = command;
    return;
  }
  command.mode = kCyclicTorque;
  command.control = next_control(feedback.status);
  state.enabled = (feedback.status & kStateBits) == kEnabled;
  if (state.enabled) {
    update_step(state, feedback.torque);
    command.torque = static_cast<std::int16_t>(std::lround(control_torque(state.wanted, feedback.torque)));
  } else {
    loop = {};
    state.wanted = 0;
    command.torque = 0;
  }
  CURRENT::command = command;
  CURRENT::state = state;
}

INDUROP_STATE(loop)
INDUROP_MODULE(run = &::run)
