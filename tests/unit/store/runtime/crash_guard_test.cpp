// SPDX-License-Identifier: Apache-2.0
// Threads of a module's own whose crash ends what they do, and nothing else.
#include <gmock/gmock.h>
#include <indurop/crash_guard.h>

#include <cstdlib>
#include <string>
#include <thread>

#include "core/rt/guard.h"

namespace {

// Empty if it returned normally.
std::string crash_of(void (*work)(void*) noexcept, void* with = nullptr) {
  indurop::rt::install_guard_handlers();
  std::string text;
  std::thread([&] {
    char why[128] = "";
    text = irp::guarded(work, with, why, sizeof why) ? "" : why;
  }).join();
  return text;
}

TEST(Guarded, Comes_back_when_it_is_done) {
  int done = 0;
  EXPECT_EQ(crash_of([](void* with) noexcept { ++*static_cast<int*>(with); }, &done), "");
  EXPECT_EQ(done, 1);
}

#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
volatile int* nowhere = nullptr;

void deepen(volatile int* left) noexcept {  // NOLINT(misc-no-recursion): until the stack ends
  volatile char here[4096];
  here[0] = 1;
  *left = *left - 1;
  if (*left > 0) {
    deepen(left);
  }
  here[1] = here[0];
}

TEST(Guarded, Says_how_it_crashed) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(crash_of([](void*) noexcept { *nowhere = 1; }), "SIGSEGV (invalid memory access) at address (nil)");
    EXPECT_EQ(crash_of([](void*) noexcept { std::abort(); }), "SIGABRT (abort or failed assertion)");
  }
  int deep = 1 << 30;
  EXPECT_THAT(crash_of([](void* left) noexcept { deepen(static_cast<int*>(left)); }, &deep),
              testing::StartsWith("stack overflow"));
}
#endif

}  // namespace
