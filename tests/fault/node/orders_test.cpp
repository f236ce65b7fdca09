// SPDX-License-Identifier: Apache-2.0
// The watchdog's order to end a module, on a machine so busy that many orders come together.

#include <pthread.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "core/rt/guard.h"
#include "node_fixture.h"

namespace indurop::test {
namespace {

TEST(Orders, That_have_queued_up_end_the_run_once) {
  SKIP_CRASHES_UNDER_TSAN();
  rt::install_guard_handlers();
  rt::Guard guard;
  std::atomic<bool> armed{false};
  std::atomic<bool> ordered{false};
  std::atomic<bool> ended{false};
  std::thread module([&] {
    const rt::HandlerStack handler_stack;
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
    guard.enter();
    if (sigsetjmp(guard.target(), 0) != 0) {
      guard.recovered();
      guard.leave();
      ended = true;
      return;
    }
    guard.arm();
    armed = true;
    while (!ordered) {
    }
    ::pthread_sigmask(SIG_UNBLOCK, &all, nullptr);
    for (volatile bool forever = true; forever;) {
    }
  });
  ASSERT_TRUE(wait_until([&] { return armed.load(); }));
  constexpr int kOrders = 500;
  for (int i = 0; i < kOrders; ++i) {
    guard.order_end(module.native_handle(), guard.current_run());
  }
  ordered = true;
  module.join();
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace indurop::test
