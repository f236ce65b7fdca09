// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/message_ring.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "core/rt/clock.h"
#include "store/runtime/host.h"
#include "test_node.h"

namespace indurop::runtime {
namespace {

using testing::TestNode;
using namespace std::chrono_literals;

constexpr rt::MonoTime kNow{};

TEST(MessageRing, Delivers_in_order_with_module_and_time) {
  TestNode node({{"a", {}, 0, {}, ""}, {"b", {}, 0, {}, ""}});
  MessageReader sut(node.run());
  ASSERT_TRUE(push_message(node.run(), 1, "one", rt::mono_time(11)));
  ASSERT_TRUE(push_message(node.run(), 1, "two", rt::mono_time(12)));
  ASSERT_TRUE(push_message(node.run(), kNoModule, "node", rt::mono_time(13)));
  Message message;
  ASSERT_TRUE(sut.next(message, kNow));
  EXPECT_EQ(message.module, 1U);
  EXPECT_EQ(message.text, "one");
  EXPECT_EQ(message.time, rt::mono_time(11));
  ASSERT_TRUE(sut.next(message, kNow));
  EXPECT_EQ(message.text, "two");
  ASSERT_TRUE(sut.next(message, kNow));
  EXPECT_EQ(message.text, "node");
  EXPECT_EQ(message.module, kNoModule);
  EXPECT_FALSE(sut.next(message, kNow));
}

TEST(MessageRing, Drops_and_counts_when_full) {
  TestNode node;
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(push_message(node.run(), 0, "fits", kNow));
  }
  EXPECT_FALSE(push_message(node.run(), 0, "too much", kNow));
  EXPECT_FALSE(push_message(node.run(), 0, "too much", kNow));
  EXPECT_EQ(node.module(0).lost_messages, 2U);
  MessageReader sut(node.run());
  EXPECT_EQ(sut.lost(), 2U);
  Message message;
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(sut.has_any());
    ASSERT_TRUE(sut.next(message, kNow));
  }
  EXPECT_FALSE(sut.has_any());
  EXPECT_FALSE(sut.next(message, kNow));
  EXPECT_TRUE(push_message(node.run(), 0, "again", kNow));
  ASSERT_TRUE(sut.next(message, kNow));
  EXPECT_EQ(message.text, "again");
}

TEST(MessageRing, Cuts_text_longer_than_an_entry) {
  TestNode node;
  ASSERT_TRUE(push_message(node.run(), 0, std::string(2000, 'x'), kNow));
  MessageReader sut(node.run());
  Message message;
  ASSERT_TRUE(sut.next(message, kNow));
  EXPECT_EQ(message.text, std::string(scheduler::kMessageText, 'x'));
}

TEST(MessageRing, Goes_on_after_a_producer_that_never_finished) {
  TestNode node;
  node.run().rings()[0].head.fetch_add(1);  // what a producer leaves that is killed with its ticket in hand
  ASSERT_TRUE(push_message(node.run(), 0, "behind it", kNow));
  MessageReader sut(node.run());
  Message message;
  EXPECT_TRUE(sut.has_any());
  EXPECT_FALSE(sut.next(message, kNow)) << "it may still be finished";
  EXPECT_FALSE(sut.next(message, kNow + kUnfinishedMessage - 1ns));
  ASSERT_TRUE(sut.next(message, kNow + kUnfinishedMessage));
  EXPECT_EQ(message.text, "behind it");
  EXPECT_EQ(sut.lost(), 1U);
  for (int i = 0; i < 20; ++i) {  // the given-up entry is in use again
    ASSERT_TRUE(push_message(node.run(), 0, "next", kNow));
    ASSERT_TRUE(sut.next(message, kNow));
  }
}

TEST(MessageRing, Keeps_every_message_of_several_threads_whole) {
  TestNode node({{"m", {}, 0, {}, ""}}, testing::sample_schema(), 64);
  constexpr int kThreads = 2;
  constexpr int kMessages = 5000;
  std::atomic<int> finished{0};
  std::vector<std::thread> producers;
  for (int t = 0; t < kThreads; ++t) {
    producers.emplace_back([&node, &finished, t] {
      for (int i = 0; i < kMessages;) {
        const std::string text =
            std::to_string(t) + " " + std::to_string(i) + std::string(static_cast<std::size_t>(i % 300), 'x');
        if (push_message(node.run(), 0, text, rt::mono_time(i))) {
          ++i;
        } else {
          std::this_thread::yield();
        }
      }
      ++finished;
    });
  }
  MessageReader sut(node.run());
  std::map<int, int> next;
  Message message;
  int count = 0;
  EXPECT_TRUE(testing::wait_until([&] {
    while (sut.next(message, kNow)) {
      const int thread = message.text[0] - '0';
      const int number = next[thread]++;
      const std::string expected = std::to_string(thread) + " " + std::to_string(number) +
                                   std::string(static_cast<std::size_t>(number % 300), 'x');
      EXPECT_EQ(message.text, expected);
      ++count;
    }
    return count == kThreads * kMessages || ::testing::Test::HasFailure();
  }));
  for (auto& producer : producers) {
    producer.join();
  }
}

}  // namespace
}  // namespace indurop::runtime
