// SPDX-License-Identifier: Apache-2.0
// The emergency stop: a sporadic module that runs when the circuit opens or a person reaches into the light curtain,
// right after the inputs were read. It tells everybody; the robot brakes on its path and takes the power away.
#include <indurop/indurop.h>

#include <indurop/generated.h>

using namespace PLC_ROBOT;

namespace {

bool open_circuit() {
  return I14 == 0;
}
bool in_curtain() {
  return I15 == 0;
}

}  // namespace

// Also when all is well again: the stop then ends, though nothing moves before it is reset.
extern "C" int condition() {
  const EMERGENCY_STOP_t now = EMERGENCY_STOP;
  return (now.bCircuit != 0) != open_circuit() || (now.bCurtain != 0) != in_curtain();
}

extern "C" void run() {
  auto stop = lock(EMERGENCY_STOP);
  const bool was_active = stop->bActive != 0;
  stop->bCircuit = open_circuit();
  stop->bCurtain = in_curtain();
  stop->bActive = open_circuit() || in_curtain();
  if (stop->bActive != 0 && !was_active) {
    ++stop->nCount;
    stop->tReaction = irp::now_ns() - irp::release_ns();
  }
}

INDUROP_STATE()
