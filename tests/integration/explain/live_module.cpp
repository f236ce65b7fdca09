// SPDX-License-Identifier: Apache-2.0
// Modules that do what the script wants, by ROLE: first and second run one after the other, event in between if it
// comes, thrower faults, process is killed.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <stdexcept>

namespace {

[[maybe_unused]] void spin(std::uint32_t ms) {
  for (const std::int64_t begin = irp::now_ns(); irp::now_ns() - begin < std::int64_t{ms} * 1'000'000;) {
  }
}

}  // namespace

#if ROLE == 1
void onRun() {
  el::ticks = el::ticks + 1;
  el::held = static_cast<std::int32_t>(irp::tick() % 1000);
  if (el::first_wanted != el::first_done && irp::tick() % 2 == 0) {
    el::tick = irp::tick();
    spin(el::spin_ms);
    el::first_done = static_cast<std::uint32_t>(el::first_wanted);
  }
}
INDUROP_MODULE(run = &::onRun)
#elif ROLE == 2
void onRun() {
  static_cast<void>(static_cast<std::uint32_t>(el::first_done));
  static_cast<void>(static_cast<std::int32_t>(el::free));
}
INDUROP_MODULE(run = &::onRun)
#elif ROLE == 3
extern "C" int condition() {
  return el::event_wanted != el::event_done && irp::tick() % 2 == 0 ? 1 : 0;
}
extern "C" void run() {
  el::tick = irp::tick();
  spin(el::spin_ms);
  el::event_done = static_cast<std::uint32_t>(el::event_wanted);
}
#elif ROLE == 4
void onRun() {
  if (el::throw_wanted != el::throw_done) {
    el::tick = irp::tick();
    el::throw_done = static_cast<std::uint32_t>(el::throw_wanted);
    throw std::runtime_error("wanted");
  }
}
INDUROP_MODULE(run = &::onRun)
#else
int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  while (irp::waitPeriod()) {
    el::process_runs = el::process_runs + 1;
  }
  return 0;
}
#endif
