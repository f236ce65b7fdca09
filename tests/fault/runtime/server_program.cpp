// SPDX-License-Identifier: Apache-2.0
// A process that implements shared functions and does nothing else.

#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <chrono>
#include <thread>

using namespace std::chrono_literals;

INDUROP_IMPLEMENT(knu::Robot::add, [](double a, double b) { return a + b; })
INDUROP_IMPLEMENT(knu::Robot::nap, [](std::uint32_t ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
  return ms;
})

int main() {
  if (irp::attach() < 0) {
    return 1;
  }
  while (!irp::stop_requested()) {
    std::this_thread::sleep_for(1ms);
  }
  return 0;
}
