// SPDX-License-Identifier: Apache-2.0
// Shared functions within one process: the call always goes through the store's slots.

#include <gtest/gtest.h>
#include <indurop/indurop.h>

#include <atomic>
#include <csignal>
#include <stdexcept>
#include <thread>

#include <indurop/generated.h>
#include "core/rt/guard.h"
#include "hosted.h"

namespace {

using namespace std::chrono_literals;
using namespace knu::Robot;
using indurop::Errc;
using indurop::testing::Hosted;
using indurop::testing::TestNode;
using indurop::testing::wait_until;

std::atomic<int> g_counted{0};
std::atomic<int> g_sleeping{0};
std::atomic<bool> g_wake{false};
constexpr std::uint32_t kCrash = 666;

double my_add(double a, const double& b) {
  if (a > 1000) {
    throw std::runtime_error("too big");
  }
  return a + b;
}

// Sleeps until the test says so; calls another function of the same module.
std::uint32_t my_nap(std::uint32_t value) {
  if (value == kCrash) {
    ::raise(SIGFPE);
  }
  ++g_sleeping;
  while (value != 0 && !g_wake) {
    std::this_thread::sleep_for(1ms);
  }
  --g_sleeping;
  return static_cast<std::uint32_t>(add(value, 1));
}

}  // namespace

INDUROP_IMPLEMENT(knu::Robot::add, &my_add)
INDUROP_IMPLEMENT(knu::Robot::count, [] { ++g_counted; });
INDUROP_IMPLEMENT(knu::Robot::nap, &my_nap);

namespace {

class Calls : public ::testing::Test {
 protected:
  void serve() {
    ASSERT_TRUE(indurop::runtime::start_function_servers(0, -1));
    ASSERT_TRUE(wait_until([] { return add(0, 0).ok() && count().ok(); }));
    g_counted = 0;
    g_wake = false;
  }
  TestNode node_;
  Hosted hosted_{node_};
};

TEST_F(Calls, Return_the_result) {
  serve();
  const double sum = add(1.0, 2.0);
  EXPECT_EQ(sum, 3.0);
  joints[0].x = 4;
  auto result = add(joints[0].x, 0.5);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value(), 4.5);
  count();
  EXPECT_TRUE(count().ok());
  EXPECT_EQ(g_counted, 2);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(double{add(i, 0.25)}, i + 0.25 > 1000.25 ? 0 : i + 0.25);
  }
}

TEST_F(Calls, Of_a_function_without_a_server_fail_at_once) {
  const auto result = add.within(1h)(1, 2);
  EXPECT_FALSE(result.ok());
  EXPECT_EQ(result.error(), Errc::NotFound);
  try {
    (void)result.value();
    FAIL();
  } catch (const indurop::call_error& error) {
    EXPECT_STREQ(error.what(), "knu::Robot::add: no module implements it (absent)");
    EXPECT_EQ(error.code(), Errc::NotFound);
  }
  EXPECT_THROW(count(), indurop::call_error) << "a failure that is not checked is thrown";
  EXPECT_THROW((void)(double{add(1, 2)} + 1), indurop::call_error);
}

TEST_F(Calls, Are_refused_after_the_server_has_stopped) {
  serve();
  indurop::runtime::stop_function_servers();
  EXPECT_EQ(add(1, 2).error(), Errc::NotFound);
  serve();
  EXPECT_TRUE(add(1, 2).ok());
}

TEST_F(Calls, Report_a_throwing_implementation_to_the_caller) {
  serve();
  EXPECT_EQ(add(2000, 1).error(), Errc::Failed);
  EXPECT_NE(indurop::testing::printed(node_).find("knu::Robot::add threw: too big"), std::string::npos);
  EXPECT_TRUE(add(1, 1).ok());
}

TEST_F(Calls, Give_up_at_their_deadline_and_ignore_the_late_answer) {
  serve();
  EXPECT_EQ(nap.within(20ms)(1).error(), Errc::Timeout);
  EXPECT_TRUE(wait_until([] { return g_sleeping == 1; }));
  EXPECT_EQ(add.within(20ms)(5, 5).error(), Errc::Timeout) << "the one thread is busy";
  g_wake = true;
  EXPECT_EQ(double{add(7, 1)}, 8.0);
  EXPECT_EQ(std::uint32_t{nap(2)}, 3U);
}

TEST_F(Calls, Are_busy_when_all_slots_wait) {
  serve();
  std::atomic<int> busy{0};
  std::vector<std::thread> callers;
  for (int i = 0; i < 17; ++i) {
    callers.emplace_back([&busy] { busy += nap.within(60s)(1).error() == Errc::Busy ? 1 : 0; });
  }
  EXPECT_TRUE(wait_until([&busy] { return busy == 1; }));
  g_wake = true;
  for (auto& caller : callers) {
    caller.join();
  }
  EXPECT_EQ(busy, 1);
  EXPECT_TRUE(add(1, 1).ok());
}

TEST_F(Calls, From_several_threads_get_each_their_own_answer) {
  serve();
  std::atomic<int> wrong{0};
  std::vector<std::thread> callers;
  for (int t = 0; t < 4; ++t) {
    callers.emplace_back([&wrong, t] {
      for (int i = 0; i < 500; ++i) {
        auto result = add.within(10s)(t, i / 1000.0);
        wrong += result.ok() && result.value() == t + i / 1000.0 ? 0 : 1;
      }
    });
  }
  for (auto& caller : callers) {
    caller.join();
  }
  EXPECT_EQ(wrong, 0);
}

TEST_F(Calls, Thrown_out_of_by_a_fault_leave_no_slot_behind) {
  serve();
  for (int i = 0; i < 3; ++i) {
    std::thread caller([] { (void)nap.within(1ms)(1).ok(); });
    caller.join();
  }
  g_wake = true;
  ASSERT_TRUE(wait_until([] { return add(1, 1).ok(); }));
  // A jump out of the wait is the same as never reaching the end of the call: the slot stays locked by this thread.
  indurop::runtime::release_calls_of_this_thread();
  EXPECT_TRUE(nap(0).ok());
}

TEST_F(Calls, Of_a_crashing_implementation_fail_and_its_module_serves_no_more) {
  indurop::rt::install_guard_handlers();
  serve();
  EXPECT_EQ(nap.within(60s)(kCrash).error(), Errc::Failed);
  EXPECT_NE(indurop::testing::printed(node_).find("knu::Robot::nap crashed with signal 8"), std::string::npos);
  EXPECT_TRUE(wait_until([] { return add(1, 1).error() == Errc::NotFound; }));
  EXPECT_EQ(nap(1).error(), Errc::NotFound);
}

TEST(CallsWithoutANode, Fail) {
  EXPECT_EQ(add(1, 2).error(), Errc::NotFound);
}

TEST(CallsOfAnotherType, Fail) {
  auto schema = indurop::testing::sample_schema();
  schema.functions[0].result = schema.functions[2].result;
  schema.functions[0].type_hash = hash_of(schema.functions[0]);
  TestNode node({{"m", {}, 0, {}, ""}}, schema);
  const Hosted hosted(node);
  ASSERT_TRUE(indurop::runtime::start_function_servers(0, -1));
  ASSERT_TRUE(wait_until([] { return count().ok(); }));
  EXPECT_EQ(add(1, 2).error(), Errc::TypeMismatch);
  const auto lines = indurop::runtime::take_binding_errors();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("knu::Robot::add: has another type in node"), std::string::npos) << lines[0];
}

}  // namespace
