// SPDX-License-Identifier: Apache-2.0
// Processes killed while they print: the reader sees whole messages only, and goes on.

#include <gtest/gtest.h>
#include <indurop/indurop.h>

#include <random>
#include <string>
#include <thread>

#include "core/rt/clock.h"
#include "hosted.h"
#include "tests/support/forked.h"

namespace {

using indurop::testing::Hosted;
using indurop::testing::TestNode;

TEST(PrintFault, Killed_producers_leave_only_whole_messages) {
  TestNode node({{"m", {}, 0, {}, ""}}, {}, 64);
  const Hosted hosted(node);
  indurop::runtime::MessageReader reader(node.run());
  indurop::runtime::Message message;
  const std::string tail(200, 'x');
  const std::string end = " " + tail + "\n";
  std::mt19937 random(3);
  int whole = 0;
  for (int i = 0; i < 300; ++i) {
    indurop::test::Forked producer([&]() -> int {
      for (int n = 0;; ++n) {
        irp::printf("message %d of %d %s\n", n, i, tail);
      }
    });
    const auto until = indurop::rt::now_ns() + static_cast<std::int64_t>(random() % 1'000'000);
    while (indurop::rt::now_ns() < until) {
      while (reader.next(message, indurop::rt::MonoClock::now())) {
        ASSERT_TRUE(message.text.starts_with("message ")) << message.text;
        ASSERT_TRUE(message.text.ends_with(end)) << message.text;
        ++whole;
      }
    }
    producer.kill_and_wait();
  }
  EXPECT_GT(whole, 0);
  // However many were killed with a ticket in hand: the ring works again after the reader's patience is over.
  EXPECT_TRUE(indurop::testing::wait_until([&] {
    irp::printf("last\n");
    bool last = false;
    while (reader.next(message, indurop::rt::MonoClock::now())) {
      last = last || message.text == "last\n";
    }
    return last;
  }));
}

}  // namespace
