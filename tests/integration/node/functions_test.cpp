// SPDX-License-Identifier: Apache-2.0
// Shared functions between modules: thread or process, absent, and dead in between.

#include <indurop/result.h>

#include <csignal>

#include "node_fixture.h"

namespace indurop::test {
namespace {

const Module kCaller = {
    .file = "caller.so", .name = "caller", .period = "5ms", .priority = 2, .more = "<budget>off</budget>"};

class Functions : public NodeTest {
 protected:
  bool answers_reach(std::uint32_t number) {
    return wait_until([&] { return value<std::uint32_t>("nt::answers") >= number; });
  }
  void stop(Program& program) {
    program.signal(SIGTERM);
    EXPECT_EQ(program.wait(), 0);
  }
};

TEST_F(Functions, Of_a_thread_module_answer_another_module) {
  Program& sut = start_and_wait({{.file = "server.so", .name = "server"}, kCaller});
  EXPECT_TRUE(answers_reach(20));
  EXPECT_EQ(value<double>("nt::sum"), 5.0);
  stop(sut);
}

TEST_F(Functions, Of_a_process_module_answer_a_thread) {
  Program& sut = start_and_wait({{.file = "server_process.exe", .name = "server", .type = "process"}, kCaller});
  EXPECT_TRUE(answers_reach(20));
  EXPECT_EQ(value<double>("nt::sum"), 5.0);
  stop(sut);
}

TEST_F(Functions, Without_an_implementation_fail_with_a_clear_error) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter"}, kCaller});
  EXPECT_TRUE(wait_until([&] { return value<std::uint32_t>("nt::failures") >= 5; }));
  EXPECT_EQ(value<std::int32_t>("nt::failure"), static_cast<int>(Errc::NotFound));
  EXPECT_EQ(value<std::uint32_t>("nt::answers"), 0U);
  EXPECT_TRUE(sut.says("caller calls shared functions, but no module implements one"));
  stop(sut);
}

TEST_F(Functions, Of_a_process_that_is_killed_fail_and_come_back_with_it) {
  Program& sut = start_and_wait({{.file = "server_process.exe",
                                  .name = "server",
                                  .type = "process",
                                  .more = "<restart delay=\"50ms\" max=\"1000\"/>"},
                                 kCaller});
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(answers_reach(value<std::uint32_t>("nt::answers") + 5));
    const auto failures = value<std::uint32_t>("nt::failures");
    ::kill(module("server").pid.load(), SIGKILL);
    ASSERT_TRUE(wait_until([&] { return value<std::uint32_t>("nt::failures") > failures; }));
  }
  ASSERT_TRUE(answers_reach(value<std::uint32_t>("nt::answers") + 5));
  EXPECT_EQ(value<double>("nt::sum"), 5.0);
  stop(sut);
}

}  // namespace
}  // namespace indurop::test
