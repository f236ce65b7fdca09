// SPDX-License-Identifier: Apache-2.0
// Enables each drive as the standard says (CiA 402), then lets it swing around where it was, each axis a little later
// than the one before.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace {

constexpr double kCounts = 1'320'000;  // of one turn
constexpr double kDegree = kCounts / 360;
constexpr double kAmplitude = 10 * kDegree;
constexpr double kTurnsPerSecond = 0.5;
constexpr double kPi = 3.14159265358979323846;
constexpr std::uint16_t kStateBits = 0x6F;
constexpr std::uint16_t kEnabled = 0x27;
constexpr std::int8_t kCyclicPosition = 8;

struct Axis {
  std::int32_t begin = 0;
  std::int64_t ticks = 0;  // since it was enabled
};
std::array<Axis, AXES::COUNT> axes;

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

// Begins and ends without a jump of speed.
double offset(const Axis& axis, std::size_t number) {
  const double time = static_cast<double>(axis.ticks) * static_cast<double>(irp::period().count()) * 1e-9;
  const double late = std::max(0.0, time - 0.05 * static_cast<double>(number));
  return kAmplitude * (1 - std::cos(2 * kPi * kTurnsPerSecond * late)) / 2;
}

}  // namespace

void run() {
  const auto feedback = AXES::feedback.get();
  auto command = AXES::command.get();
  auto state = AXES::state.get();
  state.enabled = 0;
  state.deviation = 0;
  for (std::size_t i = 0; i < feedback.size(); ++i) {
    Axis& axis = axes[i];
    const bool is_enabled = (feedback[i].status & kStateBits) == kEnabled;
    command[i].mode = kCyclicPosition;
    command[i].control = next_control(feedback[i].status);
    if (!is_enabled) {
      axis = {feedback[i].position, 0};
      command[i].position = feedback[i].position;
      continue;
    }
    ++state.enabled;
    state.deviation = std::max(state.deviation, std::abs(command[i].position - feedback[i].position) / kDegree);
    command[i].position = axis.begin + static_cast<std::int32_t>(offset(axis, i));
    ++axis.ticks;
  }
  AXES::command = command;
  AXES::state = state;
}

INDUROP_STATE(axes)
INDUROP_MODULE(run = &::run)
