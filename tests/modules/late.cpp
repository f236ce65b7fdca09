// SPDX-License-Identifier: Apache-2.0
// Takes 5 ms now and then, and writes its tick and its release: those after such a run are late.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <chrono>
#include <thread>

namespace {
int run_number = 0;
}  // namespace

extern "C" void run() {
  if (++run_number % 20 == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  nt::pace.walked = static_cast<std::int64_t>(irp::tick());
  nt::walked = irp::release_ns();
}
