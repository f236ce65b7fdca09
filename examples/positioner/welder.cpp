// SPDX-License-Identifier: Apache-2.0
// Enables the robot and starts its job.
#include <indurop/indurop.h>

#include <indurop/generated.h>

using namespace PLC_ROBOT;

namespace {

std::uint32_t asked = 0;

void ask(OPCODE_ROBOT_SERVICE code) {
  asked = ROBOT_MODULE_STATE.nAcknowledge + 1;
  auto service = lock(ROBOT_MODULE_SERVICE);
  service->eOpCode = code;
  service->nJob = 1;
  service->nRequest = asked;
}

}  // namespace

void run() {
  if (asked != 0 && ROBOT_MODULE_STATE.nDone != asked) {
    return;
  }
  if (ROBOT_MODULE_STATE.eState == ROBOT_GROUP_DISABLED) {
    ask(SVC_AD_GROUP_ENABLE);
  } else if (ROBOT_MODULE_STATE.eState == ROBOT_GROUP_STANDBY) {
    ask(SVC_JB_START);
  }
}

INDUROP_STATE(asked)
INDUROP_MODULE(run = &::run, name = "welder", description = "starts the job of the robot")
