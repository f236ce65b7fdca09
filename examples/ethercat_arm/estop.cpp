// SPDX-License-Identifier: Apache-2.0
// The emergency stop of the arm on a bus: as that of the robot cell, and also while a device on the bus does not
// answer. Who does not know where an axis is moves none. A frame that is lost now and then stops nothing.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>
#include <cstdint>

using namespace PLC_ROBOT;

namespace {

constexpr std::uint8_t kGood = 1;
constexpr int kPatience = 3;  // ticks without data of a device

int ticks_lost = kPatience;  // there was none yet

bool has_data() {
  const auto quality = BUS::quality.get();
  return quality.inputs == kGood && quality.outputs == kGood &&
         std::all_of(quality.drives.begin(), quality.drives.end(), [](std::uint8_t drive) { return drive == kGood; });
}
bool is_lost() {
  return ticks_lost >= kPatience;
}
bool open_circuit() {
  return I14 == 0;
}
bool in_curtain() {
  return I15 == 0;
}

}  // namespace

// In each tick. Also when all is well again: the stop then ends, though nothing moves before it is reset.
extern "C" int condition() {
  ticks_lost = has_data() ? 0 : std::min(ticks_lost + 1, kPatience);
  const EMERGENCY_STOP_t now = EMERGENCY_STOP;
  const auto bus = BUS::state.get();
  return (now.bCircuit != 0) != open_circuit() || (now.bCurtain != 0) != in_curtain() || (bus.bLost != 0) != is_lost();
}

extern "C" void run() {
  const bool lost = irp::learned(is_lost() ? 1 : 0) != 0;  // a replay does not evaluate the condition
  auto stop = lock(EMERGENCY_STOP);
  const bool was_active = stop->bActive != 0;
  stop->bCircuit = open_circuit();
  stop->bCurtain = in_curtain();
  stop->bActive = open_circuit() || in_curtain() || lost;
  if (stop->bActive != 0 && !was_active) {
    ++stop->nCount;
    stop->tReaction = irp::now_ns() - irp::release_ns();
  }
  auto bus = BUS::state.get();
  bus.bLost = lost ? 1 : 0;
  BUS::state = bus;
}

INDUROP_STATE(ticks_lost)
