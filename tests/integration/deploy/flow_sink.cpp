// SPDX-License-Identifier: Apache-2.0
// Module of board b, in versions chosen by a definition.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdint>
#include <stdexcept>

#include "flow_factor.h"

namespace {

std::uint64_t turns = 0;
[[maybe_unused]] std::uint64_t turns_of_this_version = 0;
[[maybe_unused]] std::uint64_t last = 0;

}  // namespace

void onRun() {
  ++turns;
  ++turns_of_this_version;
  xt::b_turns = turns;
  xt::b_seen = static_cast<std::uint64_t>(xt::a_turns);
#if defined(FLOW_THROWS)
  if (turns_of_this_version > 20) {
    throw std::runtime_error("no flow");
  }
#endif
#if defined(FLOW_NEW) || defined(FLOW_THROWS)
  const std::uint64_t flow = xt::flow;
  const std::uint64_t count = flow * xt_flow::kInverse;
  const auto all = xt::wide.get();
  bool wrong = count > (std::uint64_t{1} << 32U) || (last != 0 && count < last);
  for (const std::uint64_t one : all) {
    wrong = wrong || one != all[0];
  }
  if (wrong) {
    xt::b_wrong = xt::b_wrong + 1;
  }
  last = count;
  xt::b_flow = flow;
#elif defined(FLOW_OTHER)
  xt::b_seen = static_cast<std::uint64_t>(static_cast<double>(xt::flow));
#endif
}

INDUROP_STATE(turns)
INDUROP_MODULE(run = &::onRun)
