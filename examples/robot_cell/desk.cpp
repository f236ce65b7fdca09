// SPDX-License-Identifier: Apache-2.0
// The desk of the operator: starts the job whose number is set in BENCH::job. Before that it switches the drives on,
// or resets the robot after an error.
#include <indurop/indurop.h>

#include <indurop/generated.h>

using namespace PLC_ROBOT;

namespace {

std::uint32_t asked = 0;
std::uint16_t started = 0;

void ask(OPCODE_ROBOT_SERVICE code, std::uint16_t job) {
  asked = ROBOT_MODULE_STATE.nAcknowledge + 1;
  auto service = lock(ROBOT_MODULE_SERVICE);
  service->eOpCode = code;
  service->nJob = job;
  service->nRequest = asked;
}

}  // namespace

void run() {
  const std::uint16_t job = BENCH::job;
  if (job == 0) {
    started = 0;
  }
  if (job == started || ROBOT_MODULE_STATE.nDone < asked) {  // others may have requested something since
    return;
  }
  if (ROBOT_MODULE_STATE.eState == ROBOT_GROUP_ERRORSTOP) {
    ask(SVC_AD_GROUP_RESET, 0);
  } else if (ROBOT_MODULE_STATE.eState == ROBOT_GROUP_DISABLED) {
    ask(SVC_AD_GROUP_ENABLE, 0);
  } else if (ROBOT_MODULE_STATE.eState == ROBOT_GROUP_STANDBY) {
    ask(SVC_JB_START, job);
    started = job;
  }
}

INDUROP_STATE(asked, started)
INDUROP_MODULE(run = &::run, name = "desk", description = "starts jobs")
