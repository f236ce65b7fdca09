// SPDX-License-Identifier: Apache-2.0
// Works for as long as the property `rounds` says, and shares nothing.
#include <indurop/indurop.h>

#include <cstdint>

namespace {

std::int64_t g_rounds = 0;

}  // namespace

void onStart() {
  g_rounds = irp::property<std::int64_t>("rounds", 10'000);
}

void onRun() {
  std::uint64_t value = 1;
  for (std::int64_t i = 0; i < g_rounds; ++i) {
    value = value * 6364136223846793005U + 1442695040888963407U;
    asm volatile("" : "+r"(value));
  }
}

INDUROP_MODULE(start = &::onStart, run = &::onRun)
