// SPDX-License-Identifier: Apache-2.0
// Gives power to two robots and starts the first job of each, as a PLC program would.
#include <indurop/indurop.h>

#include <indurop/generated.h>

namespace {

template <class OpCode, class State, class Job, class Service>
void ask(const State& state, const Job& job, Service& service) {
  const bool answered = state.nAcknowledge == service.nRequest && state.nDone == service.nRequest;
  if (!answered || job.nJob != 0) {
    return;
  }
  service.nJob = 1;
  const bool stands_by = static_cast<int>(state.eState) == PLC_ROBOT::ROBOT_GROUP_STANDBY;
  service.eOpCode = static_cast<OpCode>(stands_by ? PLC_ROBOT::SVC_JB_START : PLC_ROBOT::SVC_AD_GROUP_ENABLE);
  service.nRequest = service.nRequest + 1;
}

}  // namespace

void run() {
  PLC_ROBOT::I14 = 1;
  PLC_ROBOT::I15 = 1;
  if (PLC_ROBOT::EMERGENCY_STOP.bActive == 0) {
    ask<PLC_ROBOT::OPCODE_ROBOT_SERVICE>(PLC_ROBOT::ROBOT_MODULE_STATE, PLC_ROBOT::ROBOT_JOB,
                                         PLC_ROBOT::ROBOT_MODULE_SERVICE);
    ask<PLC_ROBOT2::OPCODE_ROBOT_SERVICE>(PLC_ROBOT2::ROBOT_MODULE_STATE, PLC_ROBOT2::ROBOT_JOB,
                                          PLC_ROBOT2::ROBOT_MODULE_SERVICE);
  }
}

INDUROP_MODULE(run = &::run, name = "both_robots", description = "starts the jobs of two robots")
