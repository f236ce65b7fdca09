// SPDX-License-Identifier: Apache-2.0
// Lets the arm swing. When something has pushed against it, waits until the contact ends, and continues the motion.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>

using namespace PLC_ROBOT;

namespace {

constexpr int kCalmRuns = 125;  // half a second

std::uint32_t asked = 0;
int calm = 0;
std::int64_t push_began = 0;
bool noted = false;

bool answered() {
  return asked == 0 || ROBOT_MODULE_STATE.nDone == asked;
}

void ask(OPCODE_ROBOT_SERVICE code) {
  asked = ROBOT_MODULE_STATE.nAcknowledge + 1;
  auto service = lock(ROBOT_MODULE_SERVICE);
  service->eOpCode = code;
  service->nJob = 1;
  service->nRequest = asked;
}

bool is_pushed() {
  const auto pushed = CONTACT::pushed.get();
  return std::any_of(pushed.begin(), pushed.end(), [](double push) { return push != 0; });
}

void note_contact() {
  auto seen = lock(CONTACT::seen);
  ++seen->nStops;
  seen->nAxis = ROBOT_MODULE_STATE.nErrorAxis;
  seen->tNoticed = irp::release_ns() - push_began;
  seen->message = ROBOT_JOB.cMessage;
}

}  // namespace

void run() {
  const bool pushed = is_pushed();
  if (!pushed || push_began == 0) {
    push_began = pushed ? irp::release_ns() : 0;
  }
  calm = pushed ? 0 : calm + 1;
  const bool contact = ROBOT_MODULE_STATE.nError == ROBOT_ERR_CONTACT;
  if (contact && !noted) {
    note_contact();
  }
  noted = contact;
  if (!answered()) {
    return;
  }
  if (ROBOT_MODULE_STATE.eState == ROBOT_GROUP_ERRORSTOP && calm > kCalmRuns) {
    ask(SVC_AD_GROUP_RESET);
  } else if (ROBOT_MODULE_STATE.eState == ROBOT_GROUP_DISABLED) {
    ask(SVC_AD_GROUP_ENABLE);
  } else if (ROBOT_MODULE_STATE.eState == ROBOT_GROUP_STANDBY && ROBOT_MODE.eMode != ROBOT_MODE_MANUAL) {
    ask(ROBOT_JOB.bResume != 0 ? SVC_JB_RESUME : SVC_JB_START);
  }
}

INDUROP_MODULE(run = &::run, name = "swing", description = "lets the arm swing")
