// SPDX-License-Identifier: Apache-2.0
// Shared functions between processes that are killed at random moments: every call ends, no answer is another call's,
// no slot is lost.

#include <gtest/gtest.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <atomic>
#include <random>
#include <thread>

#include "hosted.h"
#include "hosted_program.h"
#include "store/vars/call_layout.h"
#include "tests/support/forked.h"

namespace {

using namespace std::chrono_literals;
using namespace knu::Robot;
using indurop::Errc;
using indurop::test::Forked;
using indurop::test::Program;
using indurop::testing::Hosted;
using indurop::testing::hosted_program;
using indurop::testing::TestNode;
using indurop::testing::wait_until;

constexpr int kKills = 1000;
constexpr int kServerKills = 100;

bool served() {
  return wait_until([] { return add(1, 1).ok(); });
}

// All slots can be in use at once: none is lost.
void expect_all_slots_usable() {
  std::atomic<int> failed{0};
  std::vector<std::thread> callers;
  for (std::size_t i = 0; i < indurop::vars::kCallSlots; ++i) {
    callers.emplace_back([&failed] { failed += nap.within(60s)(20).ok() ? 0 : 1; });
  }
  for (auto& caller : callers) {
    caller.join();
  }
  EXPECT_EQ(failed, 0);
}

TEST(CallFault, Killed_callers_lose_no_slot) {
  TestNode node;
  Program server = hosted_program(SERVER_PROGRAM, node.name(), "");
  const Hosted hosted(node);
  ASSERT_TRUE(served()) << server.out();
  std::mt19937 random(1);
  for (int i = 0; i < kKills; ++i) {
    Forked caller([&]() -> int {
      for (;;) {
        (void)add.within(1s)(i, 1).ok();
      }
    });
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 1000));
    caller.kill_and_wait();
    if (i % 10 == 0) {
      auto mine = add.within(60s)(i, 0.5);
      ASSERT_TRUE(mine.ok()) << to_string(mine.error());
      ASSERT_EQ(mine.value(), i + 0.5);
    }
  }
  expect_all_slots_usable();
}

TEST(CallFault, A_killed_server_is_noticed_and_its_successor_serves) {
  TestNode node;
  const Hosted hosted(node);
  EXPECT_EQ(nap(1).error(), Errc::NotFound);
  {
    Program server = hosted_program(SERVER_PROGRAM, node.name(), "");
    ASSERT_TRUE(served()) << server.out();
    std::atomic<int> waiting{0};
    std::thread caller([&waiting] {
      waiting = 1;
      EXPECT_EQ(nap.within(1h)(3'600'000).error(), Errc::Dead);
    });
    ASSERT_TRUE(wait_until([&waiting] { return waiting == 1; }));
    server.kill();
    caller.join();
    EXPECT_EQ(add.within(1h)(1, 1).error(), Errc::Dead);
  }
  Program next = hosted_program(SERVER_PROGRAM, node.name(), "");
  ASSERT_TRUE(served()) << next.out();
  expect_all_slots_usable();
}

TEST(CallFault, Servers_killed_at_random_never_give_a_wrong_answer) {
  TestNode node;
  const Hosted hosted(node);
  std::atomic<bool> stop{false};
  std::atomic<int> wrong{0};
  std::atomic<int> answers{0};
  std::vector<std::thread> callers;
  for (int t = 0; t < 2; ++t) {
    callers.emplace_back([&, t] {
      for (int i = 0; !stop; ++i) {
        auto result = add.within(50ms)(t * 1'000'000.0, i);
        if (result.ok()) {
          ++answers;
          wrong += result.value() == t * 1'000'000.0 + i ? 0 : 1;
        } else {
          std::this_thread::yield();
        }
      }
    });
  }
  std::mt19937 random(2);
  for (int i = 0; i < kServerKills; ++i) {
    Program server = hosted_program(SERVER_PROGRAM, node.name(), "");
    const int before = answers;
    EXPECT_TRUE(wait_until([&] { return answers > before; })) << server.out();
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
  }
  stop = true;
  for (auto& caller : callers) {
    caller.join();
  }
  EXPECT_EQ(wrong, 0);
  Program last = hosted_program(SERVER_PROGRAM, node.name(), "");
  ASSERT_TRUE(served()) << last.out();
  expect_all_slots_usable();
}

TEST(CallFault, A_second_implementation_is_rejected_with_the_reason) {
  TestNode node;
  const Hosted hosted(node);
  Program first = hosted_program(SERVER_PROGRAM, node.name(), "");
  ASSERT_TRUE(served());
  Program second = hosted_program(SERVER_PROGRAM, node.name(), "");
  EXPECT_TRUE(
      second.prints("shared function knu::Robot::add: implemented twice, process " + std::to_string(first.pid())));
  first.kill();
  EXPECT_TRUE(served()) << "the second one takes over";
}

TEST(CallFault, A_server_follows_the_node_to_its_next_block) {
  auto node = std::make_unique<TestNode>();
  Program server = hosted_program(SERVER_PROGRAM, node->name(), "");
  {
    const Hosted hosted(*node);
    ASSERT_TRUE(served()) << server.out();  // otherwise it could start just while there is no block
  }
  auto schema = indurop::testing::sample_schema();
  schema.variables.pop_back();
  node->restart(schema, {{"m", {}, 0, {}, ""}});
  {
    const Hosted hosted(*node);
    EXPECT_TRUE(served()) << server.out();
  }
  server.kill();
}

}  // namespace
