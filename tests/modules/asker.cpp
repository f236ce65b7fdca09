// SPDX-License-Identifier: Apache-2.0
// What it writes is what a shared function, a channel and the clock gave it. With ASKS_AS_PROCESS it is a process.
#include <indurop/channel.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

namespace {

channel::Handle handle;

void ask() {
  if (auto result = nt::add(1.0, 2.0); result.ok()) {
    nt::sum = result.value();
    ++nt::answers;
  } else {
    ++nt::failures;
  }
  std::uint64_t looks = 0;
  if (channel::read(handle, "nt::looks", sizeof looks, &looks) == sizeof looks) {
    nt::newest = looks;
  }
  nt::asked_ns = irp::now_ns();
}

}  // namespace

#ifdef ASKS_AS_PROCESS
int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  while (irp::waitPeriod()) {
    ask();
  }
  return 0;
}
#else
void onRun() {
  ask();
}
INDUROP_MODULE(run = &::onRun)
#endif
