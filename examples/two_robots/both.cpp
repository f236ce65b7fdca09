// SPDX-License-Identifier: Apache-2.0
// Enables both robots and starts their jobs, and again whenever they have ended. A job that failed or was stopped is
// left to the operator, who may resume it.
#include <indurop/indurop.h>

#include <indurop/generated.h>

namespace {

template <class OpCode, class State, class Job, class Service>
void serve(const State& state, const Job& job, Service& service) {
  if (state.nDone != service.nRequest) {
    return;
  }
  const auto ask = [&](int code) {
    const std::uint32_t number = state.nAcknowledge + 1;
    auto request = lock(service);
    request->eOpCode = static_cast<OpCode>(code);
    request->nJob = 1;
    request->nRequest = number;
  };
  const int group = static_cast<int>(state.eState);
  const int last = static_cast<int>(job.eState);
  if (group == PLC_ROBOT::ROBOT_GROUP_DISABLED) {
    ask(PLC_ROBOT::SVC_AD_GROUP_ENABLE);
  } else if (group == PLC_ROBOT::ROBOT_GROUP_STANDBY && job.bResume == 0 &&
             (last == PLC_ROBOT::ROBOT_JOB_IDLE || last == PLC_ROBOT::ROBOT_JOB_ENDED)) {
    ask(PLC_ROBOT::SVC_JB_START);
  }
}

}  // namespace

void run() {
  serve<PLC_ROBOT::OPCODE_ROBOT_SERVICE>(PLC_ROBOT::ROBOT_MODULE_STATE, PLC_ROBOT::ROBOT_JOB,
                                         PLC_ROBOT::ROBOT_MODULE_SERVICE);
  serve<PLC_ROBOT2::OPCODE_ROBOT_SERVICE>(PLC_ROBOT2::ROBOT_MODULE_STATE, PLC_ROBOT2::ROBOT_JOB,
                                          PLC_ROBOT2::ROBOT_MODULE_SERVICE);
}

INDUROP_MODULE(run = &::run, name = "both", description = "starts the jobs of both robots")
