// SPDX-License-Identifier: Apache-2.0
// Starts a thread of its own in start(), which crashes below irp::guarded() after five runs; run() says how.
#include <indurop/crash_guard.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>

namespace {

constexpr int kGoodRuns = 5;
std::atomic<bool> guarded{false}, may_crash{false}, crashed{false};
volatile std::uintptr_t bad_address = 0x10;
char why[96] = "";
int runs = 0;
std::thread worker;

void wait_a_little() {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void crash(void* /*with*/) noexcept {
  guarded = true;
  while (!may_crash) {
    wait_a_little();
  }
  *reinterpret_cast<volatile int*>(bad_address) = 1;  // NOLINT(performance-no-int-to-ptr): to crash
}

}  // namespace

void onStart() {
  worker = std::thread([] { crashed = !irp::guarded(crash, nullptr, why, sizeof why); });
  while (!guarded) {  // what comes later in the node's start must not take the guard away
    wait_a_little();
  }
}

void onRun() {
  may_crash = ++runs > kGoodRuns;
  if (crashed) {
    throw std::runtime_error(why);
  }
}

void onStop() {
  may_crash = true;
  worker.join();
}

INDUROP_MODULE(run = &::onRun, start = &::onStart, stop = &::onStop)
