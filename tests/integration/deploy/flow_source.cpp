// SPDX-License-Identifier: Apache-2.0
// Module of board a, in versions chosen by a definition: without and with variables that board b reads from it. Also as
// a process module (FLOW_AS_PROCESS).
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdint>

#include "flow_factor.h"

namespace {

std::uint64_t turns = 0;

}  // namespace

void onRun() {
  ++turns;
#if !defined(FLOW_ADDED)
  xt::a_turns = turns;
#endif
#if defined(FLOW_NEW) || defined(FLOW_ADDED)
  xt::flow = turns * xt_flow::kFactor;
  INDUROP_TYPEOF(xt::wide)::whole_type all;
  all.fill(turns);
  xt::wide = all;
#elif defined(FLOW_OTHER)
  xt::flow = static_cast<double>(turns);
#endif
}

INDUROP_STATE(turns)
#if defined(FLOW_AS_PROCESS)
int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  while (irp::waitPeriod()) {
    onRun();
  }
  return 0;
}
#else
INDUROP_MODULE(run = &::onRun)
#endif
