// SPDX-License-Identifier: Apache-2.0
// Reads all variables together and counts what it sees. With LOOKS_AS_PROCESS it is a process.
#include "snapshot_variables.h"

using namespace sn;

namespace {

uint64_t last = 0;

template <class... Value>
bool all_equal(const std::array<uint64_t, 20>& first, const Value&... values) {
  return first.front() == first.back() && ((values == first) && ...);
}

void look() {
  const auto all = snapshot(ALL_VARIABLES);
  const bool equal = std::apply([](const auto&... values) { return all_equal(values...); }, all.values());
  auto now = lock(seen);
  ++now->looks;
  now->coherent += all.coherent() ? 1 : 0;
  now->mixed += all.coherent() && !equal ? 1 : 0;
  now->ticks += all.coherent() && all.get<0>()[0] != last ? 1 : 0;
  last = all.get<0>()[0];
}

}  // namespace

#ifdef LOOKS_AS_PROCESS
int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  while (irp::waitPeriod()) {
    look();
  }
  return 0;
}
#else
void onRun() {
  look();
}
INDUROP_MODULE(run = &::onRun)
#endif
